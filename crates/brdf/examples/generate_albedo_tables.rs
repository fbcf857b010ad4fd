//! Writes the tables of directional albedo that compensation of energy uses.
//!
//! ```sh
//! cargo run --release -p etendue-brdf --example generate_albedo_tables > table_data.rs
//! mv table_data.rs crates/brdf/src/microfacet/albedo/
//! ```

use etendue_brdf::microfacet::LossTable;
use etendue_brdf::{BeckmannLambda, Distribution, Masking};

fn main() {
    println!("// Written by examples/generate_albedo_tables.rs; not edited by hand.");
    println!(
        "\n#[allow(clippy::approx_constant, reason = \"1 − E is ln 2 for GGX at α = 1 and normal incidence\")]"
    );
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
        for row in loss {
            println!("            [");
            numbers(row, "                ");
            println!("            ],");
        }
        println!("        ],");
        println!("        average: [");
        numbers(average, "            ");
        println!("        ],");
        println!("    }};");
    }
    println!("}}");
}

/// Eight numbers to a line, in the shortest digits that read back as the same bits.
fn numbers(values: &[f32], indent: &str) {
    for line in values.chunks(8) {
        let line: Vec<String> = line.iter().map(|x| format!("{x:?}")).collect();
        println!("{indent}{},", line.join(", "));
    }
}
