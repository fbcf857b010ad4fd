//! The circumstances of a run.

use time::OffsetDateTime;

/// Name and value of each: what a reader needs to compare two runs.
pub(super) fn of_this_run() -> Vec<(String, String)> {
    let mut facts = vec![
        ("date", OffsetDateTime::now_utc().date().to_string()),
        ("version", env!("CARGO_PKG_VERSION").to_owned()),
        ("float backend", backend().to_owned()),
        ("target", format!("{} {}", std::env::consts::ARCH, std::env::consts::OS)),
    ];
    if let Some(name) = processor() {
        facts.push(("processor", name));
    }
    facts.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

fn backend() -> &'static str {
    if cfg!(feature = "libm") { "libm" } else { "std" }
}

/// The class of the processor, where the system tells it.
fn processor() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    line.split_once(':').map(|(_, name)| name.trim().to_owned())
}
