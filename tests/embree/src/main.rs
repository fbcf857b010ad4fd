//! Rays per second beside Embree 4, on the same meshes and the same rays: see the README.

mod embree;
mod kinds;
mod leaks;
mod mesh;
mod random;
mod rays;
mod trace;

use std::path::PathBuf;
use std::time::Instant;

use embree::Embree;
use kinds::{Kind, NAMES};
use trace::Contender;

const USAGE: &str = "\
etendue-embree [OPTIONS] MESH…

MESH…            files of meshes: `bunny`, `dragon` and `teapot` in their names say which is which
--embree FILE    the library (libembree4.so); without it étendue is measured alone
--only NAMES     some of bunny,scans,dragon,interior,stadium,slivers
--size N         rays along each side of the picture (512)
--repeat N       repetitions, of which the least time of each chunk counts (7)
--builds N       repetitions of building (3)
--leaks N        instead: so many rays at edges, vertices and along axes of closed meshes";

#[derive(Default)]
struct Options {
    embree: Option<PathBuf>,
    files: Vec<PathBuf>,
    only: Option<String>,
    size: Option<u32>,
    repeat: Option<usize>,
    builds: Option<usize>,
    leaks: Option<usize>,
}

fn options() -> Result<Options, String> {
    let mut options = Options::default();
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().ok_or(format!("{argument} wants a value"));
        let number = |text: String| text.parse::<usize>().map_err(|e| format!("{text}: {e}"));
        match argument.as_str() {
            "--embree" => options.embree = Some(value()?.into()),
            "--only" => options.only = Some(value()?),
            "--size" => options.size = Some(number(value()?)? as u32),
            "--repeat" => options.repeat = Some(number(value()?)?),
            "--builds" => options.builds = Some(number(value()?)?),
            "--leaks" => options.leaks = Some(number(value()?)?),
            name if name.starts_with('-') => return Err(USAGE.to_owned()),
            file => options.files.push(file.into()),
        }
    }
    Ok(options)
}

fn main() {
    let options = options().unwrap_or_else(|message| {
        eprintln!("{message}");
        std::process::exit(2)
    });
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let embree = options.embree.as_ref().map(|path| {
        Embree::load(path, threads).unwrap_or_else(|error| {
            eprintln!("{}: {error}", path.display());
            std::process::exit(2)
        })
    });
    if let Some(rays) = options.leaks {
        return leaks::report(embree.as_ref(), rays);
    }
    let mut all: Vec<Vec<f64>> = Vec::new();
    for name in NAMES {
        let wanted = |only: &String| only.split(',').any(|part| part == name);
        if !options.only.as_ref().is_none_or(wanted) {
            continue;
        }
        match kinds::make(name, &options.files) {
            Some(kind) => all.push(report(&kind, embree.as_ref(), &options)),
            None => println!("{name}: no mesh of that name"),
        }
    }
    if embree.is_some() && !all.is_empty() {
        let mean = |i: usize| all.iter().map(|row| row[i]).sum::<f64>() / all.len() as f64;
        println!(
            "mean ratio: primary {:.2}, bounce {:.2}, shadow {:.2}, ambient {:.2}",
            mean(0),
            mean(1),
            mean(2),
            mean(3)
        );
    }
}

/// Measures a kind and prints its table; the ratios of the four columns.
fn report(kind: &Kind, embree: Option<&Embree>, options: &Options) -> Vec<f64> {
    let triangles = kind.mesh.triangles.len();
    println!("{}: {triangles} triangles", kind.name);
    let builds = options.builds.unwrap_or(3);
    // The mesh with what it knows of its triangles is made before the clock starts, as vertices and indices are for Embree.
    let geometry = kind.mesh.geometry();
    let mut ours = f64::INFINITY;
    let mut theirs = [f64::INFINITY; 2];
    for _ in 0..builds {
        let builder = kind.mesh.builder();
        let start = Instant::now();
        let built = builder.build();
        ours = ours.min(start.elapsed().as_secs_f64());
        drop(built);
        for robust in [false, true] {
            let Some(embree) = embree else { continue };
            let prepared = embree.prepare(&kind.mesh, robust);
            let start = Instant::now();
            let scene = prepared.commit();
            let seconds = start.elapsed().as_secs_f64();
            theirs[usize::from(robust)] = theirs[usize::from(robust)].min(seconds);
            drop(scene);
        }
    }
    let scenes: Vec<_> = embree
        .iter()
        .flat_map(|embree| [false, true].map(|robust| embree.prepare(&kind.mesh, robust).commit()))
        .collect();
    let mut contenders = vec![Contender::Ours(&geometry)];
    contenders.extend(scenes.iter().map(Contender::Embree));
    let lists = rays::lists(kind, &geometry, options.size.unwrap_or(512));
    let rates: Vec<_> = lists
        .iter()
        .map(|list| trace::compare(&contenders, list, options.repeat.unwrap_or(7)))
        .collect();

    print!("{:14}", "Mrays/s");
    lists.iter().for_each(|list| print!(" {:>8} {:>5}", list.name, "ratio"));
    println!(" {:>9} {:>6}", "build ms", "B/tri");
    let mut ratios = vec![1.0; lists.len()];
    for (who, name) in
        ["étendue", "Embree", "Embree robust"].iter().enumerate().take(contenders.len())
    {
        print!("{name:14}");
        let reference = 1.min(contenders.len() - 1);
        for (column, rates) in rates.iter().enumerate() {
            let ratio = rates[who].0 / rates[reference].0;
            if who == 0 {
                ratios[column] = ratio;
            }
            print!(" {:8.2} {ratio:5.2}", rates[who].0);
        }
        let (seconds, bytes) = match who {
            0 => (ours, geometry.statistics().bytes),
            _ => (theirs[who - 1], scenes[who - 1].bytes()),
        };
        println!(" {:9.1} {:6.1}", seconds * 1e3, bytes as f64 / triangles as f64);
    }
    // Both must find the same: a few rays along edges may differ, and ties of distance.
    for (list, rates) in lists.iter().zip(&rates) {
        let [first, ..] = rates.as_slice() else { continue };
        for (name, other) in ["Embree", "Embree robust"].iter().zip(&rates[1..]) {
            let hits = first.1.hits.abs_diff(other.1.hits);
            let distance = (first.1.distance / other.1.distance.max(1e-30) - 1.0).abs();
            let differs =
                hits as f64 > 1e-4 * list.rays.len() as f64 || !list.any && distance > 1e-4;
            if differs {
                println!(
                    "  {}: {name} finds {} hits, not {}",
                    list.name, other.1.hits, first.1.hits
                );
            }
        }
    }
    ratios
}
