use etendue_math::Real;
use etendue_math::glam::DVec3;

use super::*;
use crate::camera::{FieldOfView, FovAxis};
use crate::geometry::Transform;
use crate::texture::Textures;

/// Spot lights narrow and wide, projectors, turned, shifted and unevenly scaled.
fn lights(textures: &mut Textures) -> [Light; 5] {
    let place = Transform::look_at(DVec3::new(0.3, -0.2, 0.5), DVec3::new(1.0, 2.0, 0.0), DVec3::Z);
    let place = place.expect("a direction");
    let uneven = Transform::scale(DVec3::new(1.0, 2.0, -0.5)).and_then(|s| place.compose(&s));
    let uneven = uneven.expect("regular");
    let white = textures.constant(Color::new(1.0, 1.0, 1.0));
    let spot = |to_world, cutoff: f64| {
        let light = SpotLight::new(to_world, Color::new(1.0, 1.0, 1.0), None, cutoff, cutoff);
        Light::Spot(light.expect("a spot light"))
    };
    let projector = |to_world, degrees, size| {
        let view = FieldOfView::Angle { degrees, axis: FovAxis::X };
        let light = ProjectorLight::new(to_world, white, 1.0, view, size);
        Light::Projector(light.expect("a projector"))
    };
    [
        spot(place, 20.0),
        spot(uneven, 60.0),
        spot(place, 120.0),
        projector(place, 40.0, [2, 1]),
        projector(uneven, 100.0, [1, 1]),
    ]
}

fn is_lit(light: &Light, textures: &Textures, point: Vec3) -> bool {
    match light {
        Light::Spot(light) => light.sample(point, textures).is_some(),
        Light::Projector(light) => light.sample(point, textures).is_some(),
        _ => true,
    }
}

#[test]
fn a_ray_is_lit_within_the_stretch_and_nowhere_else() {
    let mut textures = Textures::default();
    let number = |i: u32| (etendue_math::hash_u32(i) >> 8) as f32 / 16_777_216.0 * 2.0 - 1.0;
    let mut lit_rays = 0;
    for (index, light) in lights(&mut textures).into_iter().enumerate() {
        // Wider than a half space: no part of a ray is left out.
        let is_wide = index == 2;
        for ray in 0..400 {
            let vector = |j: u32| {
                Vec3::new(number(8 * ray + j), number(8 * ray + j + 1), number(8 * ray + j + 2))
            };
            let (origin, along) = (vector(0) * 3.0, vector(3).normalize());
            for length in [2.0, f32::INFINITY] {
                let stretch = light.lit_stretch(origin, along, length);
                lit_rays += u32::from(stretch.is_some());
                for step in 0..200 {
                    let s = Real::min(length, 8.0) * (step as f32 + 0.5) / 200.0;
                    // Ends are where rounding puts them: 1e-3 leaves flat crossings their digits.
                    let margin = 1e-3 * (1.0 + s);
                    let [inside, outside] = match stretch {
                        Some([start, end]) => [
                            s > start + margin && s < end - margin,
                            s < start - margin || s > end + margin,
                        ],
                        None => [false, true],
                    };
                    let found = is_lit(&light, &textures, origin + along * s);
                    assert!(
                        !inside || found || is_wide,
                        "{light:?} {origin} {along} {s} {stretch:?}"
                    );
                    // A line may touch the cone within rounding.
                    assert!(!(outside && found), "{light:?} {origin} {along} {s} {stretch:?}");
                }
            }
        }
    }
    assert!(lit_rays > 800, "{lit_rays}");
}

#[test]
fn the_whole_ray_is_lit_by_what_shines_everywhere() {
    let point =
        Light::Point(PointLight { position: Vec3::ZERO, intensity: Color::new(1.0, 1.0, 1.0) });
    assert_eq!(point.lit_stretch(Vec3::X, Vec3::Z, 3.0), Some([0.0, 3.0]));
    let light = &lights(&mut Textures::default())[2];
    let all = Some([0.0, f32::INFINITY]);
    assert_eq!(light.lit_stretch(Vec3::X, Vec3::Z, f32::INFINITY), all);
}
