// A rough GGX conductor as scalar C++ renderers have it: the peer of étendue's `rough-conductor`.
//
// The same formulas, conventions and order of steps as Mitsuba 3's `roughconductor` in its variant scalar_rgb:
// microfacet.h (GGX, visible normals through projected slopes), fresnel.h (conductor), roughconductor.cpp. Written anew for
// this comparison, in plain floats, because a call through Mitsuba's Python costs microseconds. Differences
// that are in favour of this program: the distribution is GGX at compile time, there are no masks for
// inactive lanes, no textures and no virtual calls.
//
// usage: rough_conductor nothing|eval|pdf|eval_pdf|sample|results rgb|f32 COUNT INPUTS
//
// INPUTS is what étendue's example `calls` prints for `results`: a line per pair of directions, whose first eight numbers are
// taken here. Prints nanoseconds per call, or for `results` a line each: value and density for the pair, weight and
// density for the direction that étendue sampled, and for the one sampled here its weight and density and what `eval`
// and `pdf` say of it.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <vector>

struct Vector { float x, y, z; };
struct Vector2 { float x, y; };
static inline Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
static inline Vector operator*(Vector a, float s) { return {a.x * s, a.y * s, a.z * s}; }
static inline Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
static inline float dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline Vector normalize(Vector a) { return a * (1.0f / std::sqrt(dot(a, a))); }
static inline float sqr(float x) { return x * x; }
static inline float safe_sqrt(float x) { return std::sqrt(x > 0.0f ? x : 0.0f); }

template <int N> struct Color { float c[N]; };

static const float PI = 3.14159265358979323846f;

// Concentric map of the square to the disk (Shirley, Chiu; the branch-light form).
static inline Vector2 concentric_disk(Vector2 u) {
    float x = 2.0f * u.x - 1.0f, y = 2.0f * u.y - 1.0f;
    bool quadrant = std::fabs(x) < std::fabs(y);
    float r = quadrant ? y : x, other = quadrant ? x : y;
    float phi = x == 0.0f && y == 0.0f ? 0.0f : 0.25f * PI * other / r;
    if (quadrant)
        phi = 0.5f * PI - phi;
    return {r * std::cos(phi), r * std::sin(phi)};
}

template <int N> struct RoughConductor {
    float alpha_u, alpha_v;
    Color<N> eta, k;

    float ndf(Vector m) const {
        float area = alpha_u * alpha_v;
        float value = 1.0f / (PI * area * sqr(sqr(m.x / alpha_u) + sqr(m.y / alpha_v) + sqr(m.z)));
        return value * m.z > 1e-20f ? value : 0.0f;
    }

    float smith_g1(Vector v, Vector m) const {
        float xy_alpha_2 = sqr(alpha_u * v.x) + sqr(alpha_v * v.y);
        float tan_theta_alpha_2 = xy_alpha_2 / sqr(v.z);
        float value = 2.0f / (1.0f + std::sqrt(1.0f + tan_theta_alpha_2));
        if (xy_alpha_2 == 0.0f)
            value = 1.0f;
        if (dot(v, m) * v.z <= 0.0f)
            value = 0.0f;
        return value;
    }

    static float fresnel(float cos_i, float eta_r, float eta_i) {
        float cos2 = cos_i * cos_i, sin2 = 1.0f - cos2, sin4 = sin2 * sin2;
        float temp = eta_r * eta_r - eta_i * eta_i - sin2;
        float a2pb2 = safe_sqrt(temp * temp + 4.0f * eta_i * eta_i * eta_r * eta_r);
        float a = safe_sqrt(0.5f * (a2pb2 + temp));
        float term1 = a2pb2 + cos2, term2 = 2.0f * cos_i * a;
        float r_s = (term1 - term2) / (term1 + term2);
        float term3 = a2pb2 * cos2 + sin4, term4 = term2 * sin2;
        float r_p = r_s * (term3 - term4) / (term3 + term4);
        return 0.5f * (r_s + r_p);
    }

    Color<N> fresnel(float cos_i) const {
        Color<N> f;
        for (int i = 0; i < N; ++i)
            f.c[i] = fresnel(cos_i, eta.c[i], k.c[i]);
        return f;
    }

    Color<N> eval(Vector wi, Vector wo) const {
        if (!(wi.z > 0.0f && wo.z > 0.0f))
            return {};
        Vector h = normalize(wo + wi);
        float d = ndf(h);
        if (d == 0.0f)
            return {};
        float value = d * smith_g1(wi, h) * smith_g1(wo, h) / (4.0f * wi.z);
        Color<N> f = fresnel(dot(wi, h));
        for (int i = 0; i < N; ++i)
            f.c[i] *= value;
        return f;
    }

    float pdf(Vector wi, Vector wo) const {
        if (!(wi.z > 0.0f && wo.z > 0.0f))
            return 0.0f;
        Vector h = normalize(wo + wi);
        if (!(dot(wi, h) > 0.0f && dot(wo, h) > 0.0f))
            return 0.0f;
        return ndf(h) * smith_g1(wi, h) / (4.0f * wi.z);
    }

    struct Pair { Color<N> value; float pdf; };
    Pair eval_pdf(Vector wi, Vector wo) const {
        if (!(wi.z > 0.0f && wo.z > 0.0f))
            return {};
        Vector h = normalize(wo + wi);
        float d = ndf(h);
        if (d == 0.0f)
            return {};
        float g1 = smith_g1(wi, h);
        float value = d * g1 * smith_g1(wo, h) / (4.0f * wi.z);
        Color<N> f = fresnel(dot(wi, h));
        for (int i = 0; i < N; ++i)
            f.c[i] *= value;
        return {f, d * g1 / (4.0f * wi.z)};
    }

    // Slopes of a visible normal of the surface of roughness 1.
    static Vector2 visible_slope(float cos_i, Vector2 u) {
        Vector2 p = concentric_disk(u);
        float s = 0.5f * (1.0f + cos_i);
        p.y = safe_sqrt(1.0f - sqr(p.x)) * (1.0f - s) + p.y * s;
        float x = p.x, y = p.y, z = safe_sqrt(1.0f - x * x - y * y);
        float sin_i = safe_sqrt(1.0f - sqr(cos_i));
        float norm = 1.0f / (sin_i * y + cos_i * z);
        return {(cos_i * y - sin_i * z) * norm, x * norm};
    }

    struct Sample { Vector wo; Color<N> weight; float pdf; };
    Sample sample(Vector wi, Vector2 u) const {
        Sample result = {};
        if (!(wi.z > 0.0f))
            return result;
        Vector stretched = normalize({alpha_u * wi.x, alpha_v * wi.y, wi.z});
        float sin2 = sqr(stretched.x) + sqr(stretched.y);
        float inverse = 1.0f / std::sqrt(sin2);
        bool normal = std::fabs(sin2) <= 4.0f * 5.9604645e-8f;
        float cos_phi = normal ? 1.0f : std::fmin(std::fmax(stretched.x * inverse, -1.0f), 1.0f);
        float sin_phi = normal ? 0.0f : std::fmin(std::fmax(stretched.y * inverse, -1.0f), 1.0f);
        Vector2 slope = visible_slope(stretched.z, u);
        slope = {(cos_phi * slope.x - sin_phi * slope.y) * alpha_u, (sin_phi * slope.x + cos_phi * slope.y) * alpha_v};
        Vector m = normalize({-slope.x, -slope.y, 1.0f});
        float pdf = ndf(m) * smith_g1(wi, m) * std::fabs(dot(wi, m)) / wi.z;
        Vector wo = m * (2.0f * dot(wi, m)) - wi;
        if (!(pdf != 0.0f && wo.z > 0.0f))
            return result;
        float weight = smith_g1(wo, m);
        result.wo = wo;
        result.pdf = pdf / (4.0f * dot(wo, m));
        result.weight = fresnel(dot(wi, m));
        for (int i = 0; i < N; ++i)
            result.weight.c[i] *= weight;
        return result;
    }
};

// Directions, uniforms, and étendue's results of them: value, density; direction, weight and density of the sample.
struct Inputs { Vector wo, wi; float u, v, value, pdf; Vector sampled; float weight, sampled_pdf; };

template <class T> static inline void keep(const T &value) { asm volatile("" : : "r"(&value) : "memory"); }

template <int N> static int run(const char *operation, long count, const std::vector<Inputs> &inputs) {
    RoughConductor<N> model = {0.3f, 0.2f, {}, {}};
    for (int i = 0; i < N; ++i)
        model.eta.c[i] = 0.24f, model.k.c[i] = 3.34f;
    auto time = [&](auto call) {
        auto start = std::chrono::steady_clock::now();
        long calls = 0;
        for (; calls < count; calls += (long)inputs.size())
            for (const Inputs &i : inputs)
                call(i);
        std::chrono::duration<double, std::nano> elapsed = std::chrono::steady_clock::now() - start;
        std::printf("%.2f\n", elapsed.count() / (double)calls);
        return 0;
    };
    keep(model);
    if (!std::strcmp(operation, "nothing"))
        return time([](const Inputs &i) { keep(i); });
    if (!std::strcmp(operation, "eval"))
        return time([&](const Inputs &i) { keep(model.eval(i.wo, i.wi)); });
    if (!std::strcmp(operation, "pdf"))
        return time([&](const Inputs &i) { keep(model.pdf(i.wo, i.wi)); });
    if (!std::strcmp(operation, "eval_pdf"))
        return time([&](const Inputs &i) { keep(model.eval_pdf(i.wo, i.wi)); });
    if (!std::strcmp(operation, "sample"))
        return time([&](const Inputs &i) { keep(model.sample(i.wo, {i.u, i.v})); });
    if (!std::strcmp(operation, "results")) {
        for (const Inputs &i : inputs) {
            auto at = [&](Vector w) { return typename RoughConductor<N>::Pair{model.eval(i.wo, w), model.pdf(i.wo, w)}; };
            auto pair = at(i.wi), theirs = at(i.sampled);
            auto sample = model.sample(i.wo, {i.u, i.v});
            auto own = at(sample.wo);
            std::printf("%.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g\n", pair.value.c[0] / i.wi.z, pair.pdf,
                        theirs.value.c[0] / theirs.pdf, theirs.pdf, sample.weight.c[0], sample.pdf,
                        own.value.c[0] / own.pdf, own.pdf);
        }
        return 0;
    }
    return 2;
}

int main(int argc, char **argv) {
    if (argc != 5)
        return 2;
    std::vector<Inputs> inputs;
    std::ifstream file(argv[4]);
    static_assert(sizeof(Inputs) == 15 * sizeof(float), "a line has fifteen numbers");
    for (float numbers[15]; ;) {
        for (float &x : numbers)
            file >> x;
        if (!file)
            break;
        Inputs i;
        std::memcpy(&i, numbers, sizeof i);
        inputs.push_back(i);
    }
    if (inputs.empty())
        return 2;
    long count = std::atol(argv[3]);
    return !std::strcmp(argv[2], "rgb") ? run<3>(argv[1], count, inputs) : run<1>(argv[1], count, inputs);
}
