use super::*;
use etendue_math::glam::DVec3;

/// Four columns and three rows; green is half of red and blue.
fn map() -> BitmapImage {
    let grey = [0.1, 0.5, 0.2, 0.9, 0.3, 2.0, 0.7, 0.4, 0.6, 0.8, 0.15, 1.5];
    let texels: Vec<f32> = grey.iter().flat_map(|&x| [x, 0.5 * x, x]).collect();
    BitmapImage::from_f32(4, 3, 3, &texels).expect("twelve texels")
}

fn light(to_world: &Transform) -> EnvironmentLight {
    EnvironmentLight::new(map(), *to_world, 2.0).expect("a valid light")
}

fn turned() -> Transform {
    let mirror = Transform::scale(DVec3::new(-1.0, 1.0, 1.0)).expect("a mirror");
    let rotation = Transform::rotate(DVec3::new(1.0, 2.0, 3.0), 50.0).expect("a rotation");
    rotation.compose(&mirror).expect("a regular map")
}

fn pdf(light: &EnvironmentLight, direction: Vec3) -> f32 {
    light.radiance_and_pdf(direction).1
}

/// A grid of stratified uniforms.
fn uniforms(n: u16) -> impl Iterator<Item = [f32; 2]> {
    let at = move |i| (f32::from(i) + 0.5) / f32::from(n);
    (0..n).flat_map(move |i| (0..n).map(move |j| [at(i), at(j)]))
}

#[test]
fn directions_find_mitsubas_radiance() {
    // Values of the red channel by Mitsuba 3.9.1 for the same map with scale 2.
    let cases = [
        ([1.0, 0.0, 0.0], 2.3),
        ([-1.0, 0.0, 0.0], 1.1),
        ([0.0, 0.0, 1.0], 2.7),
        ([0.0, 0.0, -1.0], 0.7),
        ([0.3, 0.5, -0.7], 0.625936),
        ([-0.6, -0.3, 0.2], 1.18739),
        ([0.01, -0.2, 1.0], 2.49561),
        ([-0.01, -0.2, 1.0], 2.46458),
        ([0.2, -0.99, 0.1], 1.77057),
    ];
    for (direction, expected) in cases {
        let found = light(&Transform::IDENTITY).radiance(Vec3::from_array(direction).normalize());
        // Six printed digits, and the rounding of angles times a contrast of about 3 per texel.
        assert!((found.r - expected).abs() < 1e-5, "{direction:?}: {found:?} {expected}");
        assert_eq!(found.g, 0.5 * found.r);
    }
    for (direction, expected) in [([1.0, 0.0, 0.0], 1.046565), ([0.3, 0.5, -0.7], 0.939805)] {
        let found = light(&turned()).radiance(Vec3::from_array(direction).normalize());
        assert!((found.r - expected).abs() < 1e-5, "{direction:?}: {found:?} {expected}");
    }
}

#[test]
fn samples_agree_with_radiance_and_density() {
    let light = light(&turned());
    let mut elsewhere = 0;
    for u in uniforms(60) {
        let sample = light.sample(u).expect("no texel is black");
        let Density::Continuous(pdf) = sample.density else { panic!("a map is no delta light") };
        // A turn to world space and back loses 1e-6 in the angles; a texel's contrast is up to 3.
        let found = light.radiance(sample.direction);
        assert!((found.r - sample.radiance.r).abs() < 2e-5, "{u:?} {found:?} {sample:?}");
        let (radiance, again) = light.radiance_and_pdf(sample.direction);
        assert_eq!(radiance, found);
        // The same, relative, near a pole where the density goes with 1/sin θ.
        if (again / pdf - 1.0).abs() > 1e-3 {
            elsewhere += 1;
        }
    }
    // The grid of uniforms does not meet the edges of cells but by chance.
    assert!(elsewhere <= 2, "{elsewhere}");
}

#[test]
fn the_density_integrates_to_one() {
    let light = light(&turned());
    let n = 64;
    // p(ω) dω with dω = 2π² sin θ du dv: constant between edges that lie on the grid's.
    let share = |[u, v]: [f32; 2]| {
        let (sin_phi, cos_phi) = Real::sin_cos(2.0 * f32::PI * u);
        let (sin_theta, cos_theta) = Real::sin_cos(f32::PI * v);
        let local = Vec3::new(sin_phi * sin_theta, cos_theta, -cos_phi * sin_theta);
        let jacobian = 2.0 * f32::PI * f32::PI * sin_theta;
        f64::from(pdf(&light, turned().vector(local)) * jacobian)
    };
    let integral = uniforms(n).map(share).sum::<f64>() / f64::from(n * n);
    // The rounding of angles is 3·10⁻⁶ of the smallest sine on the grid.
    assert!((integral - 1.0).abs() < 1e-5, "{integral}");
}

#[test]
fn the_mean_direction_of_samples_is_that_of_the_density() {
    let light = light(&Transform::IDENTITY);
    let n = 200;
    let scale = 1.0 / f64::from(n).sqr();
    let drawn: DVec3 =
        uniforms(n).filter_map(|u| light.sample(u)).map(|s| s.direction.as_dvec3()).sum();
    // Over equal solid angles: heights are evenly spread.
    let expected: DVec3 = uniforms(n)
        .map(|[u, height]| {
            let (sine, cosine) = Real::sin_cos(2.0 * f32::PI * u);
            let y = 1.0 - 2.0 * height;
            let radius = Real::sqrt(1.0 - y * y);
            let direction = Vec3::new(sine * radius, y, -cosine * radius);
            direction.as_dvec3() * (4.0 * f64::PI * f64::from(pdf(&light, direction)))
        })
        .sum();
    // Midpoint rules; the second has a jump of up to the density itself in four of 200 columns and one of 200 rows.
    let difference = (drawn - expected) * scale;
    assert!(difference.length() < 0.02, "{difference} of {}", drawn * scale);
    assert!((drawn * scale).length() > 0.2, "a direction that is preferred: {}", drawn * scale);
}

#[test]
fn what_is_no_brighter_than_the_mean_is_left_to_scattering() {
    // One texel of 1000 among 1: all but a few samples go to the four cells around it.
    let mut texels = [1.0; 64 * 33];
    texels[20 * 64 + 30] = 1000.0;
    let image = BitmapImage::from_f32(64, 33, 1, &texels).expect("texels");
    let light = EnvironmentLight::new(image, Transform::IDENTITY, 1.0).expect("a valid light");
    let bright =
        uniforms(100).filter_map(|u| light.sample(u)).filter(|s| s.radiance.r > 1.0).count();
    assert!(bright > 9_900, "{bright}");
    // 1000/2048 · π/2 · sin(5π/8) = 0.71 against 1, of which the mean on four cells is nothing.
    assert!((light.excess() - 0.415).abs() < 0.005, "{}", light.excess());
    let even = BitmapImage::from_f32(5, 4, 1, &[0.25; 20]).expect("twenty texels");
    let even = EnvironmentLight::new(even, Transform::IDENTITY, 2.0).expect("a valid light");
    assert!(even.excess() < 0.01);
    assert_eq!(uniforms(10).filter_map(|u| even.sample(u)).count(), 100);
}

#[test]
fn an_even_map_has_the_power_of_constant_light() {
    let image = BitmapImage::from_f32(5, 4, 1, &[0.25; 20]).expect("twenty texels");
    let light = EnvironmentLight::new(image, Transform::IDENTITY, 2.0).expect("a valid light");
    let expected = 4.0 * f32::PI * f32::PI * 9.0 * 0.5;
    // Luminance weights and a few roundings.
    assert!((light.power(3.0) / expected - 1.0).abs() < 1e-6);
}

#[test]
fn odd_maps_work_or_are_refused() {
    let with = |width, height, data: &[f32]| {
        let image = BitmapImage::from_f32(width, height, 1, data).expect("texels");
        EnvironmentLight::new(image, Transform::IDENTITY, 1.0).expect("a valid light")
    };
    let black = with(2, 2, &[0.0; 4]);
    assert_eq!(black.sample([0.5; 2]), None);
    assert_eq!((pdf(&black, Vec3::X), black.power(1.0)), (0.0, 0.0));
    let single = with(1, 1, &[3.0]);
    assert_eq!(single.radiance(Vec3::new(0.0, 0.6, -0.8)).r, 3.0);
    assert!(single.sample([0.3; 2]).is_some());
    assert_eq!(single.radiance(Vec3::NAN), Color::black());
    let squashed = Transform::scale(DVec3::new(1.0, 2.0, 1.0)).expect("a scaling");
    let refused = EnvironmentLight::new(map(), squashed, 1.0).err();
    assert_eq!(refused, Some(LightError::Transform));
    let refused = EnvironmentLight::new(map(), Transform::IDENTITY, f32::NAN).err();
    assert_eq!(refused, Some(LightError::Emission));
    let mirrored = Transform::scale(DVec3::new(-3.0, 3.0, 3.0)).expect("a scaling");
    assert!(EnvironmentLight::new(map(), mirrored, 1.0).is_ok());
}
