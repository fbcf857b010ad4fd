//! Values in scene files: numbers beyond their domain, and scenes that see nothing.

use crate::common::case::{Case, LIGHT, RENDER, ball, material};
use crate::common::scene;

pub(super) fn cases() -> Vec<Case> {
    [materials(), shapes(), lights(), sensors(), paths(), media(), command_lines()]
        .into_iter()
        .flatten()
        .collect()
}

/// A ball of a plugin with one float.
fn bsdf(
    what: &'static str,
    exit: i32,
    says: &'static [&'static str],
    plugin: &str,
    name: &str,
    value: &str,
) -> Case {
    let content =
        format!("<bsdf type=\"{plugin}\"><float name=\"{name}\" value=\"{value}\"/></bsdf>");
    material(what, exit, says, &content)
}

fn materials() -> Vec<Case> {
    let alpha: &[&str] = &["scene.xml:5:", "“alpha”"];
    let index: &[&str] = &["scene.xml:5:", "“int_ior”"];
    let albedo = |what, says, value: &str| {
        let text =
            format!("<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"{value}\"/></bsdf>");
        material(what, 0, says, &text)
    };
    vec![
        bsdf(
            "roughness −0.1 of metal",
            3,
            &["scene.xml:5:", "“alpha”", "-0.1"],
            "roughconductor",
            "alpha",
            "-0.1",
        ),
        bsdf("roughness −1 of plastic", 3, alpha, "roughplastic", "alpha", "-1"),
        bsdf(
            "roughness NaN of glass",
            3,
            &["scene.xml:5:", "“nan”"],
            "roughdielectric",
            "alpha",
            "nan",
        ),
        bsdf("roughness 10³⁰", 0, &[], "roughconductor", "alpha", "1e30"),
        bsdf("roughness 10⁻³⁰", 0, &[], "roughconductor", "alpha", "1e-30"),
        bsdf("roughness 0", 0, &[], "roughconductor", "alpha", "0"),
        bsdf("index 0", 3, index, "dielectric", "int_ior", "0"),
        bsdf("index −1", 3, index, "dielectric", "int_ior", "-1"),
        bsdf("index NaN", 3, &["scene.xml:5:", "“NaN”"], "dielectric", "int_ior", "NaN"),
        bsdf("index 1", 0, &[], "dielectric", "int_ior", "1"),
        bsdf(
            "index 10³⁰",
            3,
            &["scene.xml:5:", "must be in [1e-4, 1e4]"],
            "dielectric",
            "int_ior",
            "1e30",
        ),
        bsdf(
            "index 10³⁰⁰",
            3,
            &["scene.xml:5:", "must be in [1e-4, 1e4]"],
            "dielectric",
            "int_ior",
            "1e300",
        ),
        bsdf("index 1 of rough glass as air", 0, &[], "roughdielectric", "int_ior", "1.000277"),
        bsdf("index infinite", 3, &["scene.xml:5:", "“inf”"], "plastic", "int_ior", "inf"),
        bsdf(
            "metalness −1",
            0,
            &["scene.xml:5:", "“metallic” (-1, -1, -1) is clamped"],
            "principled",
            "metallic",
            "-1",
        ),
        bsdf(
            "anisotropy 2",
            0,
            &["scene.xml:5:", "“anisotropic” (2, 2, 2) is clamped"],
            "principled",
            "anisotropic",
            "2",
        ),
        bsdf(
            "exponent −1",
            0,
            &["scene.xml:5:", "“exponent” (-1, -1, -1) is clamped"],
            "phong",
            "exponent",
            "-1",
        ),
        bsdf("exponent 10³⁰", 0, &[], "phong", "exponent", "1e30"),
        bsdf(
            "absorption −1",
            0,
            &["scene.xml:5:", "“k” (-1, -1, -1) is clamped"],
            "conductor",
            "k",
            "-1",
        ),
        material(
            "opacity 2",
            0,
            &["scene.xml:5:", "“opacity”"],
            "<bsdf type=\"mask\"><float name=\"opacity\" value=\"2\"/><bsdf type=\"diffuse\"/></bsdf>",
        ),
        material(
            "blend of weight NaN",
            3,
            &["scene.xml:5:", "“nan”"],
            "<bsdf type=\"blendbsdf\"><float name=\"weight\" value=\"nan\"/><bsdf type=\"diffuse\"/><bsdf type=\"diffuse\"/></bsdf>",
        ),
        material(
            "blend of one",
            3,
            &["scene.xml:5:"],
            "<bsdf type=\"blendbsdf\"><float name=\"weight\" value=\"0.5\"/><bsdf type=\"diffuse\"/></bsdf>",
        ),
        material(
            "texture scaled by 10³⁸",
            0,
            &[],
            "<bsdf type=\"diffuse\"><texture type=\"checkerboard\" name=\"reflectance\"><transform name=\"to_uv\"><scale value=\"1e38\"/></transform></texture></bsdf>",
        ),
        material(
            "spectrum of one wavelength",
            3,
            &["scene.xml:5:", "two wavelengths"],
            "<bsdf type=\"diffuse\"><spectrum name=\"reflectance\" value=\"500:1\"/></bsdf>",
        ),
        material(
            "spectrum out of order",
            3,
            &["scene.xml:5:", "does not lie above"],
            "<bsdf type=\"diffuse\"><spectrum name=\"reflectance\" value=\"500:1, 400:1\"/></bsdf>",
        ),
        albedo("negative albedo", &["scene.xml:5:", "“reflectance”", "-0.1"], "-0.1"),
        albedo("albedo above 1", &["scene.xml:5:", "“reflectance”", "1.5"], "1.5"),
        albedo("albedo 10³⁰", &["scene.xml:5:", "“reflectance”"], "1e30"),
        albedo("albedo 1", &[], "1"),
    ]
}

fn shapes() -> Vec<Case> {
    let sphere = |what, exit, says, content: &str| Case::scene(what, exit, says, &ball(content));
    let placed = |operation: &str| format!("<transform name=\"to_world\">{operation}</transform>");
    let shape = |what, exit, says, plugin: &str, content: &str| {
        Case::scene(
            what,
            exit,
            says,
            &format!("{LIGHT}\n<shape type=\"{plugin}\">\n{content}</shape>"),
        )
    };
    vec![
        sphere(
            "radius 0",
            3,
            &["scene.xml:5:", "“radius”"],
            "<float name=\"radius\" value=\"0\"/>",
        ),
        sphere(
            "radius −1",
            3,
            &["scene.xml:5:", "“radius”"],
            "<float name=\"radius\" value=\"-1\"/>",
        ),
        sphere(
            "radius 10³⁰",
            3,
            &["reaches beyond ±2⁴⁰"],
            "<float name=\"radius\" value=\"1e30\"/>",
        ),
        sphere(
            "radius 10⁻³⁰",
            3,
            &["smaller than 2⁻⁴⁰"],
            "<float name=\"radius\" value=\"1e-30\"/>",
        ),
        sphere(
            "centre at 10³⁰",
            3,
            &["reaches beyond ±2⁴⁰"],
            "<point name=\"center\" x=\"1e30\" y=\"0\" z=\"0\"/>",
        ),
        sphere(
            "centre at NaN",
            3,
            &["scene.xml:5:", "“nan”"],
            "<point name=\"center\" x=\"nan\" y=\"0\" z=\"0\"/>",
        ),
        sphere(
            "singular transform",
            3,
            &["scene.xml:5:", "“to_world”", "singular"],
            &placed("<scale x=\"0\"/>"),
        ),
        sphere(
            "transform of NaN",
            3,
            &["scene.xml:5:", "“nan”"],
            &placed("<translate x=\"nan\"/>"),
        ),
        sphere(
            "transform that overflows",
            3,
            &["scene.xml:5:", "overflows"],
            &placed(&"<scale value=\"1e300\"/>".repeat(2)),
        ),
        sphere(
            "transform of 10³⁸",
            3,
            &["reaches beyond ±2⁴⁰"],
            &placed("<scale value=\"1e38\"/>"),
        ),
        sphere(
            "transform of 10⁻³⁸",
            3,
            &["smaller than 2⁻⁴⁰"],
            &placed("<scale value=\"1e-38\"/>"),
        ),
        sphere("sheared sphere", 3, &["scene.xml:4:"], &placed("<scale x=\"2\"/>")),
        sphere(
            "turn about no axis",
            3,
            &["scene.xml:5:", "axis"],
            &placed("<rotate angle=\"1\"/>"),
        ),
        sphere("turn by 10³⁰⁰ degrees", 0, &[], &placed("<rotate y=\"1\" angle=\"1e300\"/>")),
        sphere(
            "matrix of five numbers",
            3,
            &["scene.xml:5:", "9 or 16 numbers"],
            &placed("<matrix value=\"1 2 3 4 5\"/>"),
        ),
        sphere(
            "matrix of zeros",
            3,
            &["scene.xml:5:"],
            &placed(&format!("<matrix value=\"{}\"/>", "0 ".repeat(16))),
        ),
        sphere(
            "matrix of a projection",
            3,
            &["scene.xml:5:"],
            &placed("<matrix value=\"1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1\"/>"),
        ),
        shape(
            "cylinder without length",
            3,
            &["scene.xml:4:"],
            "cylinder",
            "<point name=\"p0\" value=\"0 0 0\"/><point name=\"p1\" value=\"0 0 0\"/>",
        ),
        shape(
            "disk of 10⁻³⁰",
            3,
            &["smaller than 2⁻⁴⁰"],
            "disk",
            &placed("<scale value=\"1e-30\"/>"),
        ),
        shape(
            "cube of 10³⁷",
            3,
            &["reaches beyond ±2⁴⁰"],
            "cube",
            &placed("<scale value=\"1e37\"/>"),
        ),
        shape(
            "rectangle of 10³⁸",
            3,
            &["reaches beyond ±2⁴⁰"],
            "rectangle",
            &placed("<scale value=\"1e38\"/>"),
        ),
        shape(
            "animation out of order",
            3,
            &["scene.xml:6:1", "increasing times, but 0.5 follows 1"],
            "sphere",
            "<animation name=\"to_world\"><transform time=\"1\"/>\n<transform time=\"0.5\"/></animation>",
        ),
        shape(
            "animation at time NaN",
            3,
            &["scene.xml:5:", "“nan”"],
            "sphere",
            "<animation name=\"to_world\"><transform time=\"nan\"/></animation>",
        ),
        shape(
            "animation without keyframes",
            3,
            &["scene.xml:5:1"],
            "sphere",
            "<animation name=\"to_world\"/>",
        ),
        shape(
            "animation of a singular keyframe",
            3,
            &["scene.xml:5:", "singular"],
            "cube",
            "<animation name=\"to_world\"><transform time=\"0\"/><transform time=\"1\"><scale x=\"0\"/></transform></animation>",
        ),
        shape(
            "flattened instance",
            3,
            &["singular"],
            "instance",
            &format!(
                "<shape type=\"shapegroup\"><shape type=\"sphere\"/></shape>{}",
                placed("<scale z=\"0\"/>")
            ),
        ),
    ]
}

fn lights() -> Vec<Case> {
    let emitter = |what, exit, says, plugin: &str, content: &str| {
        let ball = ball("").replace(LIGHT, "");
        Case::scene(
            what,
            exit,
            says,
            &format!("<emitter type=\"{plugin}\">{content}</emitter>{ball}"),
        )
    };
    vec![
        emitter(
            "direction without length",
            3,
            &["scene.xml:3:", "direction"],
            "directional",
            "<vector name=\"direction\" value=\"0 0 0\"/>",
        ),
        emitter(
            "direction of NaN",
            3,
            &["scene.xml:3:", "“nan”"],
            "directional",
            "<vector name=\"direction\" value=\"nan 0 0\"/>",
        ),
        emitter(
            "radiance −1",
            0,
            &["scene.xml:3:26", "“radiance” (-1, -1, -1) is clamped", "no light can be seen"],
            "constant",
            "<rgb name=\"radiance\" value=\"-1\"/>",
        ),
        emitter(
            "radiance 10³⁸",
            3,
            &["light 0 emits more than 2¹⁰⁰ W"],
            "constant",
            "<rgb name=\"radiance\" value=\"1e38\"/>",
        ),
        emitter(
            "radiance 10³⁰⁰",
            3,
            &["scene.xml:3:", "radiance"],
            "constant",
            "<rgb name=\"radiance\" value=\"1e300\"/>",
        ),
        emitter(
            "radiance 0",
            0,
            &["no light can be seen"],
            "constant",
            "<rgb name=\"radiance\" value=\"0\"/>",
        ),
        emitter(
            "intensity 10³⁸ in the ball",
            3,
            &["light 0 emits more than 2¹⁰⁰ W"],
            "point",
            "<rgb name=\"intensity\" value=\"1e38\"/>",
        ),
        emitter(
            "spot of 0°",
            3,
            &["scene.xml:3:"],
            "spot",
            "<float name=\"cutoff_angle\" value=\"0\"/>",
        ),
        emitter("spot of 180°", 0, &[], "spot", "<float name=\"cutoff_angle\" value=\"180\"/>"),
        emitter(
            "spot of 10³⁰°",
            3,
            &["scene.xml:3:", "cutoff_angle"],
            "spot",
            "<float name=\"cutoff_angle\" value=\"1e30\"/>",
        ),
        Case::scene(
            "light that is flattened",
            3,
            &["singular"],
            "<shape type=\"rectangle\"><transform name=\"to_world\"><scale x=\"0\"/></transform><emitter type=\"area\"/></shape>",
        ),
        Case::scene(
            "light of area 10⁻⁴⁴",
            3,
            &["smaller than 2⁻⁴⁰"],
            "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"1e-22\"/></transform><emitter type=\"area\"/></shape>",
        ),
        Case::scene("two environments", 0, &["there are no shapes"], &format!("{LIGHT}{LIGHT}")),
        Case::scene("no light", 0, &["no light can be seen"], "<shape type=\"sphere\"/>"),
        Case::scene("nothing at all", 0, &["no light can be seen", "there are no shapes"], ""),
    ]
}

/// A scene that is nothing but a sensor, whose content begins on line 3.
fn sensor(what: &'static str, exit: i32, says: &'static [&'static str], content: &str) -> Case {
    let text = format!(
        "<scene version=\"3.0.0\">\n<sensor type=\"perspective\">\n{content}\n</sensor>\n{LIGHT}\n</scene>"
    );
    Case::new(what, exit, says).file("scene.xml", text)
}

fn sensors() -> Vec<Case> {
    let film = |width: &str, height: &str| {
        format!(
            "<film type=\"hdrfilm\">\n<integer name=\"width\" value=\"{width}\"/>\n\
             <integer name=\"height\" value=\"{height}\"/></film>"
        )
    };
    let with = |content: &str| film("4", "4").replace("</film>", &format!("\n{content}</film>"));
    let fov = |degrees| format!("<float name=\"fov\" value=\"{degrees}\"/>{}", film("4", "4"));
    let look_at = |origin, up| {
        format!(
            "<transform name=\"to_world\">\n<lookat origin=\"{origin}\" target=\"0 0 0\" up=\"{up}\"/></transform>{}",
            film("4", "4")
        )
    };
    let clip = |near, far| {
        format!(
            "<float name=\"near_clip\" value=\"{near}\"/><float name=\"far_clip\" value=\"{far}\"/>{}",
            film("4", "4")
        )
    };
    vec![
        sensor("film without columns", 3, &["scene.xml:4:1", "width"], &film("0", "4")),
        sensor("film without rows", 3, &["scene.xml:5:1", "height"], &film("4", "0")),
        sensor("film of negative width", 3, &["scene.xml:4:1", "“width”", "-4"], &film("-4", "4")),
        sensor("film 2³¹ wide", 5, &["scene.xml:4:1", "2147483648"], &film("2147483648", "576")),
        sensor("film 2³³ wide", 3, &["scene.xml:4:1", "“width”"], &film("8589934592", "4")),
        sensor("film of 2⁶² pixels", 5, &["scene.xml:4:1"], &film("2147483648", "2147483648")),
        sensor("film of 2²⁸ pixels where memory is short", 5, &["memory"], &film("16384", "16384")),
        sensor("crop beyond the film", 3, &["scene.xml:6:1", "exceeds the film"], &with("<integer name=\"crop_width\" value=\"5\"/>")),
        sensor("crop that overflows", 3, &["exceeds the film"], &with("<integer name=\"crop_width\" value=\"4294967295\"/><integer name=\"crop_offset_x\" value=\"4294967295\"/>")),
        sensor("empty crop", 3, &["empty"], &with("<integer name=\"crop_width\" value=\"0\"/>")),
        sensor("filter of width 0", 3, &["scene.xml:6:", "“radius”"], &with("<rfilter type=\"box\"><float name=\"radius\" value=\"0\"/></rfilter>")),
        sensor("filter of width 10³⁰", 3, &["scene.xml:6:", "“stddev”"], &with("<rfilter type=\"gaussian\"><float name=\"stddev\" value=\"1e30\"/></rfilter>")),
        sensor("filter of 10⁹ lobes", 3, &["scene.xml:6:", "“lobes”"], &with("<rfilter type=\"lanczos\"><integer name=\"lobes\" value=\"1000000000\"/></rfilter>")),
        sensor("filter of B 10³⁰", 3, &["scene.xml:6:", "“B”"], &with("<rfilter type=\"mitchell\"><float name=\"B\" value=\"1e30\"/></rfilter>")),
        sensor("fov 0", 3, &["scene.xml:3:1", "“fov”"], &fov("0")),
        sensor("fov −1", 3, &["scene.xml:3:1", "“fov”"], &fov("-1")),
        sensor("fov 180", 3, &["scene.xml:3:1", "“fov”", "180"], &fov("180")),
        sensor("fov NaN", 3, &["scene.xml:3:1", "“NaN”"], &fov("NaN")),
        sensor("fov 179.9999999", 0, &["there are no shapes"], &fov("179.9999999999")),
        sensor("fov 10⁻³⁰", 0, &["there are no shapes"], &fov("1e-30")),
        sensor("shutter that closes early", 3, &["scene.xml:4:1", "closes at 0.5, before it opens at 1"], "<float name=\"shutter_open\" value=\"1\"/>\n<float name=\"shutter_close\" value=\"0.5\"/>"),
        sensor("keyframes out of order", 3, &["scene.xml:5:1", "increasing times, but 0.5 follows 1"], "<animation name=\"to_world\">\n<transform time=\"1\"/>\n<transform time=\"0.5\"/></animation>"),
        sensor("up along the view", 3, &["scene.xml:4:1", "up"], &look_at("0 0 5", "0 0 1")),
        sensor("up without length", 0, &["there are no shapes"], &look_at("0 0 5", "0 0 0")),
        sensor("camera at its target", 3, &["scene.xml:4:1"], &look_at("0 0 0", "0 1 0")),
        sensor("camera at 10³⁰", 0, &["there are no shapes"], &look_at("0 0 1e30", "0 1 0")),
        sensor("camera at 10³⁰⁰", 3, &["scene.xml:"], &look_at("0 0 1e300", "0 1 0")),
        sensor("near clip beyond far clip", 3, &["scene.xml:2:1", "near"], &clip("2", "1")),
        sensor("near clip 0", 3, &["scene.xml:2:1", "near"], &clip("0", "1")),
        sensor("near clip −1", 3, &["scene.xml:2:1", "near"], &clip("-1", "1")),
        sensor("far clip 10³⁰⁰", 3, &["scene.xml:2:1", "far"], &clip("1", "1e300")),
        Case::new("camera in a ball", 0, &[]).file("scene.xml", scene(&ball("<float name=\"radius\" value=\"7\"/>"))),
        Case::new("camera on a wall", 0, &[]).file("scene.xml", scene(&format!("{LIGHT}<shape type=\"rectangle\"><transform name=\"to_world\"><translate z=\"5\"/></transform></shape>"))),
    ]
}

fn paths() -> Vec<Case> {
    let sampler = |what, exit, says, count: &str| {
        sensor(
            what,
            exit,
            says,
            &format!(
                "<sampler type=\"independent\"><integer name=\"sample_count\" value=\"{count}\"/></sampler>"
            ),
        )
    };
    let integrator = |what, exit, says, content: &str, rest: &str| {
        Case::scene(
            what,
            exit,
            says,
            &format!("<integrator type=\"path\">{content}</integrator>{rest}"),
        )
    };
    // The camera is within; nothing is lost at a bounce, and nothing shines.
    let furnace = "<shape type=\"sphere\"><float name=\"radius\" value=\"9\"/><boolean name=\"flip_normals\" value=\"true\"/><bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"1\"/></bsdf></shape>";
    let count: &[&str] = &["scene.xml:3:", "sample_count"];
    vec![
        sampler("no samples", 3, count, "0"),
        sampler("−1 samples", 3, count, "-1"),
        sampler("2³² samples", 3, count, "4294967296"),
        sampler(
            "2⁶⁴ − 1 samples",
            3,
            &["scene.xml:3:", "“18446744073709551615”"],
            "18446744073709551615",
        ),
        integrator(
            "depth −2",
            3,
            &["scene.xml:3:", "max_depth"],
            "<integer name=\"max_depth\" value=\"-2\"/>",
            LIGHT,
        ),
        integrator(
            "depth 2⁶²",
            0,
            &["there are no shapes"],
            "<integer name=\"max_depth\" value=\"4611686018427387904\"/>",
            LIGHT,
        ),
        integrator(
            "roulette at 0",
            3,
            &["scene.xml:3:", "rr_depth"],
            "<integer name=\"rr_depth\" value=\"0\"/>",
            LIGHT,
        ),
        integrator("room that absorbs nothing", 0, &["no light"], "", furnace),
        integrator(
            "paths that never end",
            5,
            &["scene.xml:3:", "rr_depth"],
            "<integer name=\"rr_depth\" value=\"4294967295\"/>",
            furnace,
        ),
    ]
}

fn media() -> Vec<Case> {
    let filled = |what, exit, says, content: &str| {
        let body = format!(
            "<medium type=\"homogeneous\" name=\"interior\">\n{content}</medium><bsdf type=\"null\"/>"
        );
        Case::scene(what, exit, says, &format!("<integrator type=\"volpath\"/>{}", ball(&body)))
    };
    vec![
        filled(
            "extinction −1",
            0,
            &["scene.xml:6:", "“sigma_t” (-1, -1, -1) is clamped"],
            "<float name=\"sigma_t\" value=\"-1\"/>",
        ),
        filled("extinction 10³⁰", 0, &[], "<float name=\"sigma_t\" value=\"1e30\"/>"),
        filled(
            "extinction 10³⁰⁰",
            3,
            &["scene.xml:6:", "sigma_t"],
            "<float name=\"sigma_t\" value=\"1e300\"/>",
        ),
        filled("albedo 2 of a medium", 0, &["albedo"], "<rgb name=\"albedo\" value=\"2\"/>"),
        filled("scale −1", 3, &["scene.xml:6:", "scale"], "<float name=\"scale\" value=\"-1\"/>"),
        filled(
            "mean cosine 1",
            3,
            &["scene.xml:6:", "“g”"],
            "<phase type=\"hg\"><float name=\"g\" value=\"1\"/></phase>",
        ),
        filled(
            "mean cosine NaN",
            3,
            &["scene.xml:6:", "“nan”"],
            "<phase type=\"hg\"><float name=\"g\" value=\"nan\"/></phase>",
        ),
        filled(
            "table of zeros",
            3,
            &["scene.xml:6:", "“values”"],
            "<phase type=\"tabphase\"><string name=\"values\" value=\"0 0 0\"/></phase>",
        ),
        filled(
            "table of one value",
            3,
            &["scene.xml:6:", "at least two"],
            "<phase type=\"tabphase\"><string name=\"values\" value=\"1\"/></phase>",
        ),
        filled(
            "blend of one phase function",
            3,
            &["scene.xml:6:", "two phase functions"],
            "<phase type=\"blendphase\"><phase type=\"isotropic\"/></phase>",
        ),
    ]
}

fn command_lines() -> Vec<Case> {
    let with = |what, exit, says, arguments: &[&'static str]| {
        Case::scene(what, exit, says, LIGHT).command(&RENDER[..5]).with(arguments)
    };
    vec![
        with("--spp 0", 2, &["--spp"], &["--spp", "0"]),
        with("--spp 2⁶⁴ − 1", 2, &["--spp"], &["--spp", "18446744073709551615"]),
        with("--size 2³²×1", 2, &["--size"], &["--size", "4294967296x1"]),
        with("--size 2³¹×2³¹", 5, &["too large"], &["--size", "2147483648x2147483648"]),
        with(
            "--crop that overflows",
            2,
            &["exceeds the film"],
            &["--crop", "4294967295,0,4294967295,1"],
        ),
        with("--max-depth 2⁶³", 2, &["--max-depth"], &["--max-depth", "9223372036854775808"]),
        with("--seed −1", 2, &["unexpected argument"], &["--seed", "-1"]),
        with("--threads 10⁶", 2, &["--threads"], &["--threads", "1000000"]),
        with("-D of a megabyte", 3, &["nothing in the scene uses"], &["-D", "x=1"]),
    ]
}
