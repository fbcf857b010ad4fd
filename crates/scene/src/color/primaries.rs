//! Spectra of the three primaries.

/// The share of light of each wavelength that red reflects, every 5 nm from 360 nm.
///
/// Red, [`GREEN`] and blue, which is what these two leave of 1, are the smoothest curves
///
/// ```text
/// minimise  Σ (second differences)² + 10⁻³ Σ (first differences)²
/// 0 ≤ red, green, blue;   red + green + blue = 1;   each under D65 has the colour of its primary
/// ```
///
/// A colour is the sum of the three times its channels. So white is 1 everywhere, what is made of channels between two bounds
/// lies between them too, and every colour under daylight is itself again.
///
/// # Source
/// I. Mallett, C. Yuksel, "Spectral Primary Decomposition for Rendering with sRGB Reflectance", EGSR 2019: the idea and the
/// constraints. The values are our own solution of the quadratic program above.
#[rustfmt::skip]
pub(super) const RED: [f32; 95] = [
    0.335492, 0.315696, 0.295881, 0.276027, 0.256114, 0.236125, 0.21604, 0.195846,
    0.175531, 0.155092, 0.134548, 0.113951, 0.09342, 0.073191, 0.053688, 0.035592,
    0.019881, 0.007815, 0.000868, 0.0, 0.000216, 0.000211, 0.0, 0.0,
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    0.0, 0.008766, 0.043184, 0.110086, 0.208329, 0.330912, 0.467131, 0.604725,
    0.731795, 0.83846, 0.918218, 0.968946, 0.993513, 1.0, 1.0, 1.0,
    1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0,
    1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0,
    1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0,
    1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0,
    1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0,
];

/// The same of green.
#[rustfmt::skip]
pub(super) const GREEN: [f32; 95] = [
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    0.0, 0.0, 0.0, 0.001105, 0.015915, 0.051033, 0.108591, 0.187256,
    0.2835, 0.39194, 0.506176, 0.619468, 0.725304, 0.817926, 0.892846, 0.947386,
    0.981214, 0.996837, 1.0, 1.0, 1.0, 1.0, 1.0, 0.999582,
    0.991993, 0.969001, 0.920803, 0.844668, 0.743411, 0.623857, 0.495273, 0.367806,
    0.251102, 0.153105, 0.079074, 0.03086, 0.006487, 0.0, 0.0, 0.0,
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
];
