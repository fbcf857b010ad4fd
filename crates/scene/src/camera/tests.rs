use super::*;
use crate::film::Film;
use etendue_math::Real;
use etendue_math::glam::DVec3;

const VIEW: FieldOfView = FieldOfView::Angle { degrees: 40.0, axis: FovAxis::X };
const FILM: [u32; 2] = [40, 30];

fn view() -> Transform {
    Transform::look_at(DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.0, 0.5, -1.0), DVec3::Y)
        .expect("a regular view")
}

fn camera(projection: Projection) -> Camera {
    Camera::new(projection, view(), 0.5, 100.0, FILM).expect("a valid camera")
}

fn perspective(field_of_view: FieldOfView, principal_point_offset: [f32; 2]) -> Camera {
    camera(Projection::Perspective { field_of_view, principal_point_offset })
}

#[track_caller]
fn assert_ray(ray: Ray, origin: [f32; 3], direction: [f32; 3], t_max: f32) {
    // Six digits are printed for coordinates up to 3, eight for distances of 100.
    let [o, d] = [origin, direction].map(Vec3::from_array);
    assert!((ray.origin - o).abs().max_element() < 1e-5, "{} {o}", ray.origin);
    assert!((ray.direction - d).abs().max_element() < 2e-6, "{} {d}", ray.direction);
    assert!((ray.t_max - t_max).abs() < 5e-5, "{} {t_max}", ray.t_max);
}

#[test]
fn perspective_rays_are_mitsubas() {
    // Values by Mitsuba 3.9.1 for the film point (15, 14), reached through a crop there.
    let angle = |axis| FieldOfView::Angle { degrees: 40.0, axis };
    let along_x = ([0.841147, 1.83761, 2.55217], [-0.316347, -0.32339, -0.89182], 99.927_47);
    let along_y = ([0.826183, 1.84046, 2.55485], [-0.345003, -0.316665, -0.88357], 100.258_68);
    let diagonal = ([0.850126, 1.8359, 2.55057], [-0.298926, -0.3273, -0.896392], 99.773_8);
    let focal = ([0.82505, 1.84068, 2.55505], [-0.347151, -0.316145, -0.882914], 100.287_56);
    for (field_of_view, (origin, direction, t_max)) in [
        (angle(FovAxis::X), along_x),
        (angle(FovAxis::Larger), along_x),
        (angle(FovAxis::Y), along_y),
        (angle(FovAxis::Smaller), along_y),
        (angle(FovAxis::Diagonal), diagonal),
        (FieldOfView::FocalLength { millimetres: 35.0 }, focal),
    ] {
        let ray = perspective(field_of_view, [0.0; 2]).ray([15.0, 14.0], [0.0; 2]);
        assert_ray(ray, origin, direction, t_max);
    }
}

#[test]
fn the_principal_point_moves_as_in_mitsuba() {
    // Values by Mitsuba 3.9.1 for offsets 0.1 and −0.2.
    let ray = perspective(VIEW, [0.1, -0.2]).ray([15.0, 14.0], [0.0; 2]);
    let direction = [-0.254045, -0.220351, -0.941757];
    assert_ray(ray, [0.87193, 1.88892, 2.52524], direction, 100.320434);
}

#[test]
fn thin_lens_rays_are_mitsubas() {
    // Values by Mitsuba 3.9.1 for the film point (10, 18) and two points of the lens.
    let lens = camera(Projection::ThinLens {
        field_of_view: VIEW,
        aperture_radius: 0.2,
        focus_distance: 3.0,
    });
    let direction = [-0.344853, -0.389403, -0.854074];
    let ray = lens.ray([10.0, 18.0], [0.9, 0.5]);
    assert_ray(ray, [0.670675, 1.80341, 2.60762], direction, 100.467_02);
    let direction = [-0.397833, -0.337524, -0.853115];
    let ray = lens.ray([10.0, 18.0], [0.5, 0.1]);
    assert_ray(ray, [0.811083, 1.67811, 2.6195], direction, 101.134_315);
}

#[test]
fn all_rays_through_the_lens_meet_on_the_focal_plane() {
    let projection =
        Projection::ThinLens { field_of_view: VIEW, aperture_radius: 0.2, focus_distance: 3.0 };
    let camera = camera(projection);
    let depth = |p: Vec3| view().inverse_point(p).z;
    let meeting = |lens| {
        let ray = camera.ray([3.0, 4.0], lens);
        let per_unit = depth(ray.at(1.0)) - depth(ray.origin);
        ray.at((3.0 - depth(ray.origin)) / per_unit)
    };
    let first = meeting([0.1, 0.2]);
    for lens in [[0.9, 0.9], [0.5, 0.5], [0.99, 0.3]] {
        // Coordinates of 3 through a division by a difference of order 1.
        assert!((meeting(lens) - first).abs().max_element() < 1e-5);
    }
}

#[test]
fn orthographic_rays_are_mitsubas() {
    // Values by Mitsuba 3.9.1 with the film enlarged twofold.
    let scale = Transform::scale(DVec3::new(2.0, 2.0, 1.0)).expect("a scaling");
    let to_world = view().compose(&scale).expect("a regular map");
    let camera = Camera::new(Projection::Orthographic, to_world, 0.5, 100.0, FILM);
    let ray = camera.expect("a valid camera").ray([10.0, 18.0], [0.0; 2]);
    let direction = [-0.227921, -0.341882, -0.911685];
    assert_ray(ray, [-0.0592275, 1.54714, 2.8862], direction, 99.5);
}

#[test]
fn parameters_outside_their_domain_are_refused() {
    let error = |projection, near, far, film| {
        Camera::new(projection, Transform::IDENTITY, near, far, film).err()
    };
    let with =
        |field_of_view| Projection::Perspective { field_of_view, principal_point_offset: [0.0; 2] };
    for degrees in [0.0, 180.0, -1.0, f64::INFINITY] {
        let bad = with(FieldOfView::Angle { degrees, axis: FovAxis::X });
        assert_eq!(error(bad, 0.1, 1.0, FILM), Some(CameraError::FieldOfView(degrees)));
    }
    let bad = with(FieldOfView::FocalLength { millimetres: 0.0 });
    assert_eq!(error(bad, 0.1, 1.0, FILM), Some(CameraError::FocalLength(0.0)));
    for (near, far) in [(0.0, 1.0), (2.0, 1.0), (1.0, f32::INFINITY)] {
        let refused = error(with(VIEW), near, far, FILM);
        assert_eq!(refused, Some(CameraError::Clip { near, far }));
    }
    assert!(error(with(VIEW), f32::NAN, 1.0, FILM).is_some());
    assert_eq!(error(with(VIEW), 0.1, 1.0, [0, 5]), Some(CameraError::Film));
    assert_eq!(error(Projection::Orthographic, 0.1, 1.0, [5, 0]), Some(CameraError::Film));
    let lens = |aperture_radius, focus_distance| Projection::ThinLens {
        field_of_view: VIEW,
        aperture_radius,
        focus_distance,
    };
    assert_eq!(error(lens(-1.0, 1.0), 0.1, 1.0, FILM), Some(CameraError::Aperture(-1.0)));
    assert_eq!(error(lens(1.0, 0.0), 0.1, 1.0, FILM), Some(CameraError::FocusDistance(0.0)));
}

#[test]
fn depth_is_along_the_axis_whatever_the_scale() {
    let at = |scale: f64| {
        let scaled = view().compose(&Transform::scale(DVec3::splat(scale)).expect("a size"));
        let projection =
            Projection::Perspective { field_of_view: VIEW, principal_point_offset: [0.0; 2] };
        Camera::new(projection, scaled.expect("a transform"), 0.5, 100.0, FILM).expect("a camera")
    };
    for camera in [at(1.0), at(3.0)] {
        let axis = camera.ray([20.0, 15.0], [0.0; 2]);
        // Rays begin on the near plane, at 0.5; a few roundings of coordinates up to 13.
        assert!((camera.depth(axis.at(2.0)) - 2.5).abs() < 1e-5);
        let aside = camera.ray([0.0, 0.0], [0.0; 2]);
        let cosine = aside.direction.dot(axis.direction);
        assert!((camera.depth(aside.at(10.0)) - 0.5 - 10.0 * cosine).abs() < 1e-5);
        assert!(camera.depth(axis.at(-1.0)) < 0.0);
    }
}

#[test]
fn sight_widens_through_a_pinhole_and_stays_a_pixel_in_parallel_projection() {
    let film = Film::new(FILM);
    let ray = |camera: &Camera| camera.ray([20.0, 15.0], [0.5; 2]);
    let pinhole = perspective(VIEW, [0.0; 2]);
    let sight = Sight::new(&pinhole, &film, 4);
    // Half a pixel of 2 tan 20°/40 per unit of length, which begins half a unit before the near clipping plane.
    let pixel = 2.0 * Real::tan(f64::to_radians(20.0)) / 40.0;
    for distance in [0.5_f32, 10.0, 1000.0] {
        let found = f64::from(sight.width(ray(&pinhole).at(distance)));
        let expected = 0.5 * pixel * (f64::from(distance) + 0.5);
        // The chord of the next pixel's direction, which is not as long as the tangent.
        assert!((found / expected - 1.0).abs() < 1e-3, "{distance}: {found} {expected}");
    }
    let parallel = camera(Projection::Orthographic);
    let sight = Sight::new(&parallel, &film, 1_000_000);
    // An eighth of a fortieth of two units, at any distance.
    let found = sight.width(ray(&parallel).at(50.0));
    assert!((found - 2.0 / 40.0 / 8.0).abs() < 1e-6, "{found}");
    assert_eq!(Sight::SHARP.width(Vec3::splat(7.0)), 0.0);
}
