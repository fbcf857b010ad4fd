//! Rays from inside closed meshes at shared edges, vertices and along axes: none may get out.

use etendue_math::glam::Vec3;
use etendue_scene::geometry::Ray;

use crate::embree::Embree;
use crate::mesh::{Mesh, cuboid, grid, sphere};
use crate::random::Random;
use crate::trace::Contender;

/// A closed mesh and a ball in it, all of which is inside.
struct Closed {
    name: &'static str,
    mesh: Mesh,
    center: Vec3,
    radius: f32,
}

fn closed() -> Vec<Closed> {
    let bumpy =
        |p: Vec3| p * (1.0 + 0.1 * (9.0 * p.x).sin() * (7.0 * p.y).cos() * (8.0 * p.z).sin());
    // A torus that lies about the vertical; the ball is in its tube.
    let torus = {
        let (rows, columns) = (96_u32, 200_u32);
        let mut torus = grid(rows, columns, true, |row, column| {
            let ((s, c), (sin, cos)) = (
                (std::f32::consts::TAU * row).sin_cos(),
                (std::f32::consts::TAU * column).sin_cos(),
            );
            Vec3::new((1.0 + 0.3 * c) * cos, 0.3 * s, (1.0 + 0.3 * c) * sin)
        });
        // The last row is the first.
        let last = rows * columns;
        torus
            .triangles
            .iter_mut()
            .flatten()
            .for_each(|i| *i = if *i >= last { *i - last } else { *i });
        torus.positions.truncate(last as usize);
        torus
    };
    // A cube of squares: rays along axes meet whole rows of vertices.
    let cube = {
        let mut cube = Mesh::default();
        for axis in 0..3 {
            for side in [-1.0_f32, 1.0] {
                cube.add(&grid(16, 16, false, |u, v| {
                    let mut p = [0.0; 3];
                    (p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]) =
                        (side, 2.0 * u - 1.0, 2.0 * v - 1.0);
                    Vec3::from_array(p)
                }));
            }
        }
        cube
    };
    // Two cones with a common rim about a diagonal: long slivers with boxes all but empty.
    let spindle = {
        let axis = Vec3::ONE.normalize();
        let side = axis.cross(Vec3::X).normalize();
        let up = axis.cross(side);
        let mut spindle = Mesh { positions: vec![axis * 100.0, axis * -100.0], triangles: vec![] };
        let around = 300;
        for i in 0..around {
            let (sin, cos) = (std::f32::consts::TAU * i as f32 / around as f32).sin_cos();
            spindle.positions.push(side * cos + up * sin);
            let (a, b) = (2 + i, 2 + (i + 1) % around);
            spindle.triangles.extend([[0, a, b], [1, b, a]]);
        }
        spindle
    };
    let needle = sphere(4).map(|p| p * Vec3::new(1.0, 300.0, 0.02));
    vec![
        Closed { name: "sphere", mesh: sphere(6).map(bumpy), center: Vec3::ZERO, radius: 0.6 },
        Closed { name: "torus", mesh: torus, center: Vec3::X, radius: 0.2 },
        Closed { name: "cube", mesh: cube, center: Vec3::ZERO, radius: 0.9 },
        Closed { name: "needle", mesh: needle, center: Vec3::ZERO, radius: 0.01 },
        Closed { name: "spindle", mesh: spindle, center: Vec3::ZERO, radius: 0.5 },
        Closed {
            name: "far sphere",
            mesh: sphere(5).map(|p| p + Vec3::new(1000.0, -2000.0, 500.0)),
            center: Vec3::new(1000.0, -2000.0, 500.0),
            radius: 0.5,
        },
        Closed {
            name: "huge box",
            mesh: cuboid(Vec3::splat(-3e5), Vec3::splat(4e5)),
            center: Vec3::ZERO,
            radius: 2e5,
        },
    ]
}

/// Rays from a ball in a mesh, at a vertex, a point of an edge, or along an axis, in turn.
fn aimed(closed: &Closed, random: &mut Random, count: usize) -> Vec<Ray> {
    let Closed { mesh, center, radius, .. } = closed;
    let ray = |i: usize| {
        let origin = if i % 8 == 0 { *center } else { *center + random.in_ball() * *radius };
        let triangle = mesh.triangles[random.below(mesh.triangles.len())];
        let k = random.below(3);
        let [a, b] =
            [triangle[k], triangle[(k + 1) % 3]].map(|vertex| mesh.positions[vertex as usize]);
        match i % 3 {
            0 => Ray::new(origin, a - origin),
            1 => {
                let share = if i % 2 == 0 { 0.5 } else { random.uniform() };
                let target = a + (b - a) * share;
                Ray::new(origin, target - origin)
            }
            _ => {
                let axis = random.below(3);
                let mut direction = Vec3::ZERO;
                direction[axis] = if random.uniform() < 0.5 { -1.0 } else { 1.0 };
                // Through a vertex where that is inside, so that it is met exactly.
                let mut from = a;
                from[axis] = origin[axis];
                let inside = (from - *center).length() < *radius;
                Ray::new(if inside { from } else { origin }, direction)
            }
        }
    };
    (0..count).map(ray).collect()
}

/// Counts the rays of so many that get out, by closest and by any hit.
pub fn report(embree: Option<&Embree>, rays: usize) {
    println!(
        "{:12} {:>10} {:>16} {:>16} {:>16}",
        "closed mesh", "rays", "étendue", "Embree", "Embree robust"
    );
    println!(
        "{:12} {:>10} {:>16} {:>16} {:>16}",
        "", "", "closest / any", "closest / any", "closest / any"
    );
    let mut random = Random(7);
    let meshes = closed();
    let (each, mut ours) = (rays.div_ceil(meshes.len()), 0);
    let mut totals = vec![[0; 2]; 3];
    for closed in &meshes {
        let geometry = closed.mesh.geometry();
        let scenes: Vec<_> = embree
            .iter()
            .flat_map(|embree| {
                [false, true].map(|robust| embree.prepare(&closed.mesh, robust).commit())
            })
            .collect();
        let contenders: Vec<_> = std::iter::once(Contender::Ours(&geometry))
            .chain(scenes.iter().map(Contender::Embree))
            .collect();
        let mut leaks = vec![[0; 2]; contenders.len()];
        let mut left = each;
        while left > 0 {
            let chunk = aimed(closed, &mut random, left.min(1 << 16));
            for (contender, leaks) in contenders.iter().zip(&mut leaks) {
                for any in [false, true] {
                    leaks[usize::from(any)] += chunk.len() - contender.trace(&chunk, any).hits;
                }
            }
            left -= chunk.len();
        }
        let show = |[closest, any]: &[usize; 2]| format!("{closest} / {any}");
        print!("{:12} {each:>10}", closed.name);
        leaks.iter().for_each(|leaks| print!(" {:>16}", show(leaks)));
        println!();
        for (total, leaks) in totals.iter_mut().zip(&leaks) {
            *total = [total[0] + leaks[0], total[1] + leaks[1]];
        }
        ours += leaks[0][0] + leaks[0][1];
    }
    print!("{:12} {:>10}", "all", each * meshes.len());
    totals
        .iter()
        .take(if embree.is_some() { 3 } else { 1 })
        .for_each(|[c, a]| print!(" {:>16}", format!("{c} / {a}")));
    println!();
    assert!(ours == 0, "{ours} rays get out of closed meshes");
}
