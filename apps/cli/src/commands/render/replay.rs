//! One sample again, told ray by ray.

use etendue_math::glam::Vec3;
use etendue_renderer::{Found, RenderSettings, Renderer, Replay, SampleAddress, Step, TracedRay};
use etendue_scene::effect::Element;
use etendue_scene::{Color, Origins, Scene};
use serde_json::{Value, json};

use super::Arguments;
use crate::failure::{Exit, Failure};

/// Column, row and sample of the command line.
pub(super) fn address(text: &str) -> Result<SampleAddress, String> {
    let parts: Vec<&str> = text.split(',').map(str::trim).collect();
    if let [column, row, sample] = parts[..]
        && let (Ok(column), Ok(row), Ok(sample)) = (column.parse(), row.parse(), sample.parse())
    {
        return Ok(SampleAddress { row, column, sample });
    }
    Err("expected column, row and number of a sample, as in 12,34,5".to_owned())
}

/// Computes one sample of a scene again, and prints its path.
pub(super) fn run(
    arguments: &Arguments,
    address: SampleAddress,
    scene: &Scene,
    origins: &Origins,
) -> Result<Exit, Failure> {
    let SampleAddress { row, column, sample } = address;
    let [width, height] = scene.film.size;
    if column >= width || row >= height {
        return Err(Failure::usage(format!(
            "--replay {column},{row},{sample}: the film has {width} columns and {height} rows, both counted from 0"
        )));
    }
    let replay = Renderer::new(scene, settings(scene))?.replay([column, row], sample);
    let told = Told { scene, origins, replay };
    if arguments.json {
        println!("{}", told.json(address, scene.sampling.seed));
    } else {
        println!("column {column}, row {row}, sample {sample}, seed {}", scene.sampling.seed);
        told.print();
    }
    Ok(Exit::Done)
}

/// One thread for one sample.
pub(super) fn settings(scene: &Scene) -> RenderSettings {
    RenderSettings { threads: 1, ..RenderSettings::of_scene(scene) }
}

/// What a shape is made of, and where the file says so.
pub(super) fn material(scene: &Scene, origins: &Origins, shape: u32) -> String {
    let surface = &scene.surfaces[shape as usize];
    let material = origins.of(Element::Material(surface.material));
    let light = surface.light.and_then(|light| origins.of(Element::Light(light)));
    match (material, light) {
        (Some(material), None) => material.to_string(),
        (Some(material), Some(light)) => format!("{material}, {light}"),
        (None, Some(light)) => light.to_string(),
        (None, None) => "a material that the file does not describe".to_owned(),
    }
}

/// A path with the names of what it meets.
pub(super) struct Told<'a> {
    pub(super) scene: &'a Scene,
    pub(super) origins: &'a Origins,
    pub(super) replay: Replay,
}

impl Told<'_> {
    fn print(&self) {
        let mut before = [0.0; 3];
        for (i, step) in self.replay.steps.iter().enumerate() {
            println!("edge {}", i + 1);
            for traced in &step.rays {
                println!("  {}", self.line(traced));
            }
            let found = step.radiance.to_array();
            let more = core::array::from_fn::<f32, 3, _>(|c| found[c] - before[c]);
            println!("  brings {}", numbers(more));
            before = found;
        }
        if self.replay.steps.len() as u32 == Replay::MOST_STEPS {
            println!("and further edges, which are not shown");
        }
        println!("radiance, weighted by the filter: {}", numbers(self.replay.radiance.to_array()));
    }

    fn line(&self, traced: &TracedRay) -> String {
        let ray = &traced.ray;
        let way = format!("from {} towards {}", vector(ray.origin), vector(ray.direction));
        match &traced.found {
            Found::Surface(point, t) => format!(
                "ray {way}: after {t} at {}, {}, shape {}, primitive {}",
                vector(point.position),
                self.material(point.shape.0),
                point.shape.0,
                point.primitive
            ),
            Found::Nothing => format!("ray {way}: leaves the scene"),
            Found::Blocked => format!("to a light {way}: something is in the way"),
            Found::Free => format!("to a light {way}: it is seen"),
        }
    }

    fn material(&self, shape: u32) -> String {
        material(self.scene, self.origins, shape)
    }

    /// What a step comes from: the vertex before that edge, or what the camera sees.
    pub(super) fn source(&self, step: usize) -> String {
        let surface = |step: &Step| step.surface().map(|point| self.material(point.shape.0));
        let steps = &self.replay.steps;
        let vertex = step.checked_sub(1).and_then(|before| surface(&steps[before]));
        vertex
            .or_else(|| surface(&steps[step]))
            .unwrap_or_else(|| "light from infinitely far away".to_owned())
    }

    fn json(&self, address: SampleAddress, seed: u64) -> Value {
        let ray = |traced: &TracedRay| {
            let (what, at) = match &traced.found {
                Found::Surface(point, t) => (
                    "surface",
                    json!({
                        "position": point.position.to_array(),
                        "normal": point.normal.to_array(),
                        "distance": t,
                        "shape": point.shape.0,
                        "primitive": point.primitive,
                        "material": self.material(point.shape.0),
                    }),
                ),
                Found::Nothing => ("nothing", Value::Null),
                Found::Blocked => ("blocked", Value::Null),
                Found::Free => ("free", Value::Null),
            };
            json!({
                "origin": traced.ray.origin.to_array(),
                "direction": traced.ray.direction.to_array(),
                "found": what,
                "at": at,
            })
        };
        let step = |step: &Step| {
            json!({
                "rays": step.rays.iter().map(ray).collect::<Vec<_>>(),
                "radiance": channels(step.radiance),
            })
        };
        json!({
            "column": address.column,
            "row": address.row,
            "sample": address.sample,
            "seed": seed,
            "edges": self.replay.steps.iter().map(step).collect::<Vec<_>>(),
            "radiance": channels(self.replay.radiance),
        })
    }
}

/// JSON knows no number that is not finite: these are text.
fn channels(color: Color) -> Value {
    let channel = |c: f32| if c.is_finite() { json!(c) } else { json!(c.to_string()) };
    color.to_array().map(channel).to_vec().into()
}

fn vector(v: Vec3) -> String {
    format!("({}, {}, {})", v.x, v.y, v.z)
}

fn numbers([r, g, b]: [f32; 3]) -> String {
    format!("{r} {g} {b}")
}
