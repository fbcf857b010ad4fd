//! The same settings give the same bits, however the work is divided.

use core::sync::atomic::{AtomicBool, Ordering};
use std::sync::Mutex;

use etendue_scene::Scene;
use etendue_scene::film::{Crop, ReconstructionFilter};
use etendue_scene::scene::SamplerKind;

use super::scenes::{lamp_over_sphere, settings};
use crate::tile::Tile;
use crate::{Progress, RenderSettings, Renderer, Rendering, Strategy};

fn scene() -> Scene {
    lamp_over_sphere([70, 45])
}

fn render(scene: &Scene, settings: RenderSettings) -> Rendering {
    let renderer = Renderer::new(scene, settings).expect("threads");
    renderer.render(&|_| (), &AtomicBool::new(false))
}

fn with_threads(threads: usize, sampler: SamplerKind) -> RenderSettings {
    RenderSettings { threads, sampler, samples_per_pixel: 5, ..settings(Some(4), Strategy::Mis) }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let mut scene = scene();
    scene.film.filter = ReconstructionFilter::Gaussian { stddev: 0.5 };
    for sampler in [SamplerKind::Independent, SamplerKind::Sobol] {
        let one = render(&scene, with_threads(1, sampler));
        assert!(one.image.mean().g > 0.1);
        for threads in [2, 3, 7] {
            assert_eq!(one, render(&scene, with_threads(threads, sampler)));
        }
    }
}

#[test]
fn the_order_of_tiles_changes_nothing() {
    let scene = scene();
    let renderer = Renderer::new(&scene, with_threads(2, SamplerKind::Sobol)).expect("threads");
    let go_on = AtomicBool::new(false);
    let mut tiles = Tile::cover(&scene.film.crop);
    let rendered = |tiles: &[Tile]| {
        let rendering = Mutex::new(renderer.nothing_rendered());
        renderer.render_tiles(tiles, &rendering, &|_| (), &go_on);
        rendering.into_inner().expect("no panic")
    };
    let in_order = rendered(&tiles);
    tiles.sort_by_key(|tile| etendue_math::hash_u32(tile.offset[0] * 1000 + tile.offset[1]));
    assert_ne!(tiles, Tile::cover(&scene.film.crop));
    assert_eq!(in_order, rendered(&tiles));
}

#[test]
fn the_size_of_tiles_changes_nothing() {
    let scene = scene();
    let crop = scene.film.crop;
    let renderer = Renderer::new(&scene, with_threads(3, SamplerKind::Sobol)).expect("threads");
    let rendered = |tiles: &[Tile]| {
        let rendering = Mutex::new(renderer.nothing_rendered());
        renderer.render_tiles(tiles, &rendering, &|_| (), &AtomicBool::new(false));
        rendering.into_inner().expect("no panic")
    };
    let usual = rendered(&Tile::cover(&crop));
    let of_size = |[w, h]: [u32; 2]| -> Vec<Tile> {
        let [width, height] = crop.size;
        (0..height.div_ceil(h))
            .flat_map(|y| (0..width.div_ceil(w)).map(move |x| [x * w, y * h]))
            .map(|[x, y]| Tile { offset: [x, y], size: [w.min(width - x), h.min(height - y)] })
            .collect()
    };
    for size in [crop.size, [1, 1], [70, 1], [11, 13]] {
        let other = rendered(&of_size(size));
        assert_eq!(usual.image, other.image, "{size:?}");
        assert_eq!(usual.statistics, other.statistics, "{size:?}");
    }
}

#[test]
fn a_crop_has_the_bits_of_the_whole_picture() {
    let mut scene = scene();
    let settings = with_threads(1, SamplerKind::Sobol);
    let whole = render(&scene, settings.clone()).image;
    let crop = Crop { offset: [13, 20], size: [30, 21] };
    scene.film.crop = crop;
    let part = render(&scene, settings).image;
    for y in 0..crop.size[1] {
        for x in 0..crop.size[0] {
            let [column, row] = [x + crop.offset[0], y + crop.offset[1]];
            assert_eq!(part.pixel([x, y]), whole.pixel([column, row]));
        }
    }
}

#[test]
fn another_seed_gives_another_picture() {
    let scene = scene();
    let settings = with_threads(1, SamplerKind::Sobol);
    let other = RenderSettings { seed: 2, ..settings.clone() };
    assert_ne!(render(&scene, settings).image, render(&scene, other).image);
}

#[test]
fn every_tile_is_reported_and_a_cancelled_render_stops() {
    let scene = scene();
    let renderer = Renderer::new(&scene, with_threads(1, SamplerKind::Sobol)).expect("a thread");
    let seen = Mutex::new(Vec::new());
    let record = |progress: Progress| seen.lock().expect("no panic").push(progress);
    let rendering = renderer.render(&record, &AtomicBool::new(false));
    let seen = seen.into_inner().expect("no panic");
    // 70 × 45 pixels in tiles of 16.
    assert_eq!(seen.len(), 5 * 3);
    assert_eq!(seen.last(), Some(&rendering.progress));

    let cancel = AtomicBool::new(false);
    let stop = |_: Progress| cancel.store(true, Ordering::Relaxed);
    let rendering = renderer.render(&stop, &cancel);
    assert_eq!(rendering.progress, Progress { finished: 1, total: 15 });
    assert_eq!(rendering.statistics.samples, 16 * 16 * 5);
}
