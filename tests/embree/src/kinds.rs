//! The kinds of meshes that hierarchies are compared on, each with a camera and a light.

use std::f32::consts::{PI, TAU};
use std::path::PathBuf;

use etendue_math::glam::Vec3;

use crate::mesh::{Mesh, cuboid, grid, lathe, quad};
use crate::random::Random;

/// A mesh and from where it is looked at.
pub struct Kind {
    pub name: &'static str,
    pub mesh: Mesh,
    pub eye: Vec3,
    pub target: Vec3,
    /// Half the width of the picture at distance 1.
    pub width: f32,
    pub light: Vec3,
    /// How far ambient occlusion looks.
    pub reach: f32,
}

/// Names of all kinds, in order.
pub const NAMES: [&str; 6] = ["bunny", "scans", "dragon", "interior", "stadium", "slivers"];

/// Makes a kind; `None` for one that needs a file that is not there.
pub fn make(name: &'static str, files: &[PathBuf]) -> Option<Kind> {
    let file = |part: &str| {
        let named =
            |f: &&PathBuf| f.file_stem().is_some_and(|s| s.to_string_lossy().contains(part));
        files.iter().find(named).map(|path| Mesh::read(path))
    };
    Some(match name {
        "bunny" => bunny(file("bunny")?),
        "scans" => scans(files.iter().map(|path| Mesh::read(path)).collect()),
        "dragon" => dragon(file("dragon")?),
        "interior" => interior(),
        "stadium" => stadium(file("teapot")?),
        _ => slivers(),
    })
}

fn v(x: f32, y: f32, z: f32) -> Vec3 {
    Vec3::new(x, y, z)
}

/// A room without its front wall.
fn room(mesh: &mut Mesh, size: Vec3) {
    let (x, y, z) = (0.5 * size.x, size.y, 0.5 * size.z);
    mesh.add(&quad([v(-x, 0.0, -z), v(-x, 0.0, z), v(x, 0.0, z), v(x, 0.0, -z)]));
    mesh.add(&quad([v(-x, y, -z), v(x, y, -z), v(x, y, z), v(-x, y, z)]));
    mesh.add(&quad([v(-x, 0.0, -z), v(x, 0.0, -z), v(x, y, -z), v(-x, y, -z)]));
    mesh.add(&quad([v(-x, 0.0, -z), v(-x, y, -z), v(-x, y, z), v(-x, 0.0, z)]));
    mesh.add(&quad([v(x, 0.0, -z), v(x, 0.0, z), v(x, y, z), v(x, y, -z)]));
}

fn bunny(bunny: Mesh) -> Kind {
    let mut mesh = bunny.standing(Vec3::ZERO, 1.0, 0.3);
    room(&mut mesh, v(4.0, 2.5, 4.0));
    Kind {
        name: "bunny",
        mesh,
        eye: v(0.2, 0.9, 1.9),
        target: v(0.0, 0.5, 0.0),
        width: 0.55,
        light: v(0.8, 2.3, 0.6),
        reach: 0.5,
    }
}

/// All files on one floor, each subdivided to at least 80 000 triangles.
fn scans(files: Vec<Mesh>) -> Kind {
    let mut mesh = Mesh::default();
    for (i, file) in files.into_iter().enumerate() {
        let at = v(1.1 * (i % 3) as f32 - 1.1, 0.0, 1.1 * (i / 3) as f32 - 0.55);
        mesh.add(&file.with_at_least(80_000).standing(at, 1.0, i as f32));
    }
    mesh.add(&quad([v(-4.0, 0.0, -4.0), v(-4.0, 0.0, 4.0), v(4.0, 0.0, 4.0), v(4.0, 0.0, -4.0)]));
    Kind {
        name: "scans",
        mesh,
        eye: v(0.3, 1.6, 3.2),
        target: v(0.0, 0.35, 0.0),
        width: 0.5,
        light: v(2.0, 4.0, 2.0),
        reach: 0.5,
    }
}

/// One scan, subdivided to at least 300 000 triangles.
fn dragon(dragon: Mesh) -> Kind {
    Kind {
        name: "dragon",
        mesh: dragon.with_at_least(300_000).standing(Vec3::ZERO, 1.0, 0.0),
        eye: v(0.2, 0.6, 1.5),
        target: v(0.0, 0.32, 0.0),
        width: 0.4,
        light: v(1.0, 2.0, 1.0),
        reach: 0.3,
    }
}

fn chair(at: Vec3, angle: f32) -> Mesh {
    let mut chair = cuboid(v(-0.22, 0.43, -0.22), v(0.22, 0.47, 0.22));
    let leg = [[0.0, 0.0], [0.015, 0.0], [0.02, 0.1], [0.018, 0.25], [0.025, 0.43], [0.0, 0.43]];
    for (x, z) in [(-0.19, -0.19), (0.19, -0.19), (-0.19, 0.19), (0.19, 0.19)] {
        chair.add(&lathe(v(x, 0.0, z), &leg, 16));
    }
    for i in 0..6 {
        let x = -0.2 + 0.075 * i as f32;
        chair.add(&cuboid(v(x, 0.47, 0.19), v(x + 0.025, 0.9, 0.205)));
    }
    chair.add(&cuboid(v(-0.22, 0.88, 0.18), v(0.22, 0.95, 0.22)));
    chair.standing(at, 0.95, angle)
}

fn cabinet(at: Vec3, size: Vec3) -> Mesh {
    let mut cabinet = cuboid(at, at + size);
    let (front, inset) = (at.z + size.z, 0.05);
    let knob = [
        [0.0, 0.0],
        [0.004, 0.0],
        [0.004, 0.01],
        [0.01, 0.014],
        [0.012, 0.02],
        [0.008, 0.026],
        [0.0, 0.028],
    ];
    let doors = (size.x / 0.45).round().max(1.0);
    for i in 0..doors as u32 {
        let (a, b) = (at.x + size.x * i as f32 / doors, at.x + size.x * (i + 1) as f32 / doors);
        let (low, high) = (at.y + 0.02, at.y + size.y - 0.02);
        cabinet.add(&cuboid(v(a + 0.005, low, front), v(b - 0.005, high, front + 0.018)));
        // The frame of the panel.
        for (p, q) in [
            (v(a + 0.005, low, 0.0), v(a + inset, high, 0.0)),
            (v(b - inset, low, 0.0), v(b - 0.005, high, 0.0)),
            (v(a + inset, low, 0.0), v(b - inset, low + inset, 0.0)),
            (v(a + inset, high - inset, 0.0), v(b - inset, high, 0.0)),
        ] {
            cabinet.add(&cuboid(p + Vec3::Z * (front + 0.018), q + Vec3::Z * (front + 0.026)));
        }
        let lying = lathe(Vec3::ZERO, &knob, 16).map(|p| v(p.x, -p.z, p.y));
        cabinet.add(&lying.map(|p| p + v(b - 0.025, 0.5 * (low + high), front + 0.026)));
    }
    cabinet
}

/// A kitchen of some 57 000 triangles: walls of two triangles beside turned knobs.
fn interior() -> Kind {
    let mut random = Random(5);
    let mut mesh = Mesh::default();
    room(&mut mesh, v(6.0, 2.8, 5.0));
    let (x, z) = (3.0, 2.5);
    mesh.add(&quad([v(-x, 0.0, z), v(-x, 2.8, z), v(x, 2.8, z), v(x, 0.0, z)]));
    // Cabinets along the back, above and below, and along one side.
    mesh.add(&cabinet(v(-2.9, 0.0, -2.5), v(4.5, 0.9, 0.6)));
    mesh.add(&cuboid(v(-2.95, 0.9, -2.5), v(1.65, 0.94, -1.86)));
    mesh.add(&cabinet(v(-2.9, 1.5, -2.5), v(4.5, 0.8, 0.35)));
    mesh.add(&cabinet(v(1.9, 0.0, -2.5), v(1.0, 2.3, 0.6)));
    // Skirting boards, beams, tiles of the back wall.
    for i in 0..9 {
        let x = -2.9 + 0.7 * i as f32;
        mesh.add(&cuboid(v(x, 2.6, -2.5), v(x + 0.12, 2.8, 2.5)));
    }
    for i in 0..30 {
        for j in 0..4 {
            let at = v(-2.9 + 0.15 * i as f32, 0.95 + 0.135 * j as f32, -2.5);
            mesh.add(&cuboid(at, at + v(0.146, 0.131, 0.008)));
        }
    }
    // The table, chairs, crockery.
    mesh.add(&cuboid(v(-1.0, 0.72, -0.3), v(1.0, 0.76, 0.8)));
    let leg = [[0.0, 0.0], [0.03, 0.0], [0.04, 0.2], [0.035, 0.5], [0.05, 0.72], [0.0, 0.72]];
    for (x, z) in [(-0.9, -0.2), (0.9, -0.2), (-0.9, 0.7), (0.9, 0.7)] {
        mesh.add(&lathe(v(x, 0.0, z), &leg, 24));
    }
    for (x, z, angle) in [
        (-0.5, 1.15, 0.1),
        (0.5, 1.1, -0.2),
        (-0.5, -0.6, PI),
        (0.5, -0.65, 3.0),
        (1.4, 0.3, 1.6),
        (-1.4, 0.2, -1.5),
    ] {
        mesh.add(&chair(v(x, 0.0, z), angle));
    }
    let plate = [
        [0.0, 0.005],
        [0.07, 0.006],
        [0.085, 0.012],
        [0.125, 0.02],
        [0.127, 0.018],
        [0.088, 0.007],
        [0.07, 0.0],
        [0.0, 0.0],
    ];
    let cup = [
        [0.0, 0.004],
        [0.02, 0.005],
        [0.032, 0.03],
        [0.036, 0.08],
        [0.04, 0.08],
        [0.037, 0.03],
        [0.024, 0.0],
        [0.0, 0.0],
    ];
    let bottle = [
        [0.0, 0.0],
        [0.04, 0.0],
        [0.042, 0.02],
        [0.042, 0.18],
        [0.03, 0.22],
        [0.014, 0.25],
        [0.014, 0.3],
        [0.016, 0.305],
        [0.0, 0.31],
    ];
    for i in 0..6 {
        let at = v(
            -0.75 + 0.5 * (i % 3) as f32 + 0.1 * random.uniform(),
            0.76,
            -0.1 + 0.6 * (i / 3) as f32,
        );
        mesh.add(&lathe(at, &plate, 40));
        mesh.add(&lathe(at + v(0.2, 0.0, 0.05), &cup, 32));
    }
    for i in 0..16 {
        let at = v(
            -2.8 + 0.27 * i as f32 + 0.05 * random.uniform(),
            0.94,
            -2.3 + 0.15 * random.uniform(),
        );
        mesh.add(&lathe(at, if i % 3 == 0 { &cup } else { &bottle }, 32));
    }
    for i in 0..14 {
        let at = v(-2.7 + 0.3 * i as f32, 2.3, -2.35);
        mesh.add(&lathe(at, if i % 2 == 0 { &plate } else { &bottle }, 32));
    }
    // Lamps, curtains, a rug.
    let shade = [
        [0.0, 0.3],
        [0.03, 0.29],
        [0.05, 0.2],
        [0.12, 0.1],
        [0.2, 0.0],
        [0.198, 0.0],
        [0.118, 0.1],
        [0.048, 0.2],
        [0.0, 0.28],
    ];
    for x in [-0.6, 0.6] {
        mesh.add(&lathe(v(x, 1.7, 0.25), &shade, 48));
        mesh.add(&cuboid(v(x - 0.004, 2.0, 0.246), v(x + 0.004, 2.8, 0.254)));
    }
    for (from, to) in [(-1.9, -0.9), (0.9, 1.9)] {
        mesh.add(&grid(24, 220, false, |row, column| {
            let fold = 0.04 * (60.0 * column).sin() * (0.6 + 0.4 * row);
            v(2.92 + fold - 0.05, 2.5 - 2.4 * row, from + (to - from) * column)
        }));
    }
    mesh.add(&grid(90, 80, false, |row, column| {
        let height = 0.006 + 0.003 * (31.0 * row).sin() * (29.0 * column).cos();
        v(-1.6 + 3.2 * row, height, -0.9 + 2.4 * column)
    }));
    Kind {
        name: "interior",
        mesh,
        eye: v(-1.9, 1.55, 2.2),
        target: v(0.2, 0.9, -0.8),
        width: 0.75,
        light: v(0.6, 1.6, 0.25),
        reach: 0.6,
    }
}

/// A teapot of one unit on the field of a stadium of 240.
fn stadium(teapot: Mesh) -> Kind {
    let mut mesh = teapot.with_at_least(20_000).standing(Vec3::ZERO, 1.0, 0.4);
    mesh.add(&quad([
        v(-60.0, 0.0, -40.0),
        v(-60.0, 0.0, 40.0),
        v(60.0, 0.0, 40.0),
        v(60.0, 0.0, -40.0),
    ]));
    let ring = |radius: f32, height: f32, angle: f32| {
        let (sin, cos) = (TAU * angle).sin_cos();
        v((60.0 + radius) * cos, height, (40.0 + radius) * sin)
    };
    // Rows of seats as steps, aisles, pillars, beams of the roof.
    for row in 0..36_u8 {
        let (r, h) = (f32::from(row) * 1.2, f32::from(row) * 0.7);
        mesh.add(&grid(1, 72, true, |i, angle| ring(r, h + 0.7 * i, angle)));
        mesh.add(&grid(1, 72, true, |i, angle| ring(r + 1.2 * i, h + 0.7, angle)));
    }
    for i in 0..48_u8 {
        let angle = f32::from(i) / 48.0;
        let foot = ring(44.0, 0.0, angle);
        mesh.add(&cuboid(foot - v(0.5, 0.0, 0.5), foot + v(0.5, 40.0, 0.5)));
        let (from, to) = (ring(44.0, 40.0, angle), ring(10.0, 34.0, angle));
        let side = (to - from).cross(Vec3::Y).normalize() * 0.3;
        for shift in [Vec3::ZERO, Vec3::Y] {
            mesh.add(&quad([
                from + side + shift,
                from - side + shift,
                to - side + shift,
                to + side + shift,
            ]));
        }
    }
    mesh.add(&grid(1, 96, true, |i, angle| ring(44.0 - 34.0 * i, 41.5 - 6.0 * i, angle)));
    Kind {
        name: "stadium",
        mesh,
        eye: v(1.1, 0.8, 2.0),
        target: v(0.0, 0.45, 0.0),
        width: 0.6,
        light: v(12.0, 30.0, 8.0),
        reach: 2.0,
    }
}

/// Long thin triangles in all directions, as in wires, hair and badly exported models.
fn slivers() -> Kind {
    let mut random = Random(9);
    let mut mesh = Mesh::default();
    for _ in 0..20_000 {
        let center = random.in_ball();
        let along = random.direction() * (0.15 + 0.5 * random.uniform());
        let across = along.cross(random.direction()).normalize_or(Vec3::X) * 0.002;
        let bend = across * (3.0 * random.uniform());
        mesh.add(&quad([
            center - along - across,
            center - along + across,
            center + along + across + bend,
            center + along - across + bend,
        ]));
    }
    mesh.add(&quad([
        v(-3.0, -1.2, -3.0),
        v(-3.0, -1.2, 3.0),
        v(3.0, -1.2, 3.0),
        v(3.0, -1.2, -3.0),
    ]));
    Kind {
        name: "slivers",
        mesh,
        eye: v(0.3, 0.6, 3.2),
        target: v(0.0, -0.1, 0.0),
        width: 0.4,
        light: v(2.0, 3.0, 2.0),
        reach: 0.3,
    }
}
