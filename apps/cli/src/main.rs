//! The command `etendue`.

fn main() {}
