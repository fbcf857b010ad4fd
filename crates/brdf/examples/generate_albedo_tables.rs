//! Writes the tables of directional albedo that compensation of energy and layers use.
//!
//! ```sh
//! cargo run --release -p etendue-brdf --example generate_albedo_tables facets > data.rs
//! mv data.rs crates/brdf/src/microfacet/albedo/table_data.rs
//! ```
//!
//! Likewise `dielectric` for `microfacet/albedo/dielectric_data.rs` and `fuzz` for `openpbr/fuzz_data.rs`.

use etendue_brdf::microfacet::{DielectricTable, LossTable};
use etendue_brdf::{BeckmannLambda, Distribution, FuzzTable, Masking};

/// 1 − E is a well-known constant there.
const ALLOWED: &str = "#[allow(clippy::approx_constant, reason = \"1 − E is ln 2 for GGX at α = 1 and normal incidence\")]";

fn main() {
    let tables = std::env::args().nth(1).unwrap_or_default();
    println!("// Written by examples/generate_albedo_tables.rs; not edited by hand.\n");
    match tables.as_str() {
        "facets" => facets(),
        "dielectric" => dielectric(),
        "fuzz" => fuzz(),
        _ => {
            eprintln!("usage: generate_albedo_tables facets|dielectric|fuzz");
            std::process::exit(2);
        }
    }
}

fn facets() {
    println!("{ALLOWED}");
    println!("impl LossTable {{");
    let exact = Distribution::Beckmann { lambda: BeckmannLambda::Exact };
    for (name, what, distribution, masking) in [
        ("GGX", "GGX, height-correlated", Distribution::Ggx, Masking::HeightCorrelated),
        ("GGX_SEPARABLE", "GGX, separable", Distribution::Ggx, Masking::Separable),
        ("BECKMANN", "Beckmann, height-correlated", exact, Masking::HeightCorrelated),
    ] {
        let table = LossTable::generate(distribution, masking);
        let (loss, average) = table.data();
        println!("    /// {what} masking.");
        println!("    #[rustfmt::skip]");
        println!("    pub const {name}: Self = Self {{");
        println!("        loss: [");
        rows(loss, "            ");
        println!("        ],");
        println!("        average: [");
        numbers(average, "            ");
        println!("        ],");
        println!("    }};");
    }
    println!("}}");
}

fn dielectric() {
    println!("/// GGX, height-correlated masking.");
    println!("{ALLOWED}");
    println!("#[rustfmt::skip]");
    println!("static GGX: DielectricTable = DielectricTable([");
    for k in 0..DielectricTable::LAYERS {
        println!("    [");
        for i in 0..DielectricTable::ROWS {
            let row: [f32; DielectricTable::COLUMNS] =
                core::array::from_fn(|j| DielectricTable::entry(k, i, j));
            rows(&[row], "        ");
        }
        println!("    ],");
    }
    println!("]);");
}

fn fuzz() {
    let table = FuzzTable::generate();
    let [area, passed] = table.data();
    println!("impl FuzzTable {{");
    println!("    /// The table checked in.");
    println!("    #[rustfmt::skip]");
    println!("    pub const CHARLIE: Self = Self {{");
    for (name, part) in [("area", area), ("passed", passed)] {
        println!("        {name}: [");
        rows(part, "            ");
        println!("        ],");
    }
    println!("    }};");
    println!("}}");
}

fn rows<const N: usize>(rows: &[[f32; N]], indent: &str) {
    for row in rows {
        println!("{indent}[");
        numbers(row, &format!("{indent}    "));
        println!("{indent}],");
    }
}

/// Eight numbers to a line, in the shortest digits that read back as the same bits.
fn numbers(values: &[f32], indent: &str) {
    for line in values.chunks(8) {
        let line: Vec<String> = line.iter().map(|x| format!("{x:?}")).collect();
        println!("{indent}{},", line.join(", "));
    }
}
