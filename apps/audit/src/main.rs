//! The command `etendue-audit`.

fn main() {}
