//! The settings that a stored render depends on, by name.

use etendue_renderer::progressive::Allocation;
use etendue_scene::scene::SamplerKind;
use etendue_scene::{Effect, Scene};

use super::Arguments;
use super::task::{Method, Task};

/// Name and value, as on the command line, of everything but the files that the samples of a render depend on.
pub(super) fn settings(arguments: &Arguments, scene: &Scene, task: &Task) -> Vec<(String, String)> {
    let [width, height] = scene.film.size;
    let crop = scene.film.crop;
    let [x, y] = crop.offset;
    let [w, h] = crop.size;
    let mut settings = vec![
        ("--size", format!("{width}x{height}")),
        ("--crop", format!("{x},{y},{w},{h}")),
        ("--seed", scene.sampling.seed.to_string()),
        (
            "--sampler",
            match scene.sampling.sampler {
                SamplerKind::Independent => "independent",
                SamplerKind::Sobol => "sobol",
            }
            .to_owned(),
        ),
        ("--max-depth", scene.path.max_depth.map_or("-1".to_owned(), |depth| depth.to_string())),
        ("--features", if cfg!(feature = "libm") { "libm" } else { "std" }.to_owned()),
    ];
    if let Method::Progressive { goal, .. } = task.method {
        let allocation = match goal.allocation {
            Allocation::Adaptive => "adaptive",
            Allocation::Uniform => "uniform",
        };
        settings.push(("--allocation", allocation.to_owned()));
    }
    if scene.path.spectral {
        settings.push(("--spectral", "on".to_owned()));
    }
    let left_out = arguments.selection.left_out();
    if !left_out.is_empty() {
        let names: Vec<&str> = left_out.iter().map(|effect| effect.name()).collect();
        settings.push(("--without", names.join(",")));
    }
    let reuses = task.method == Method::Reuse;
    if reuses {
        settings.push(("--reuse", "on".to_owned()));
    }
    let filters =
        scene.effects().iter().any(|presence| presence.effect == Effect::TextureFiltering);
    if reuses || filters {
        // The pilot knows how many samples there will be; a sample stands for less of a texture the more there are.
        settings.push(("--spp", scene.sampling.samples_per_pixel.to_string()));
    }
    let named = settings.into_iter().map(|(name, value)| (name.to_owned(), value));
    named.chain(arguments.scene.settings()).collect()
}
