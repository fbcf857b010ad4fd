//! Records of one model and check together.

use crate::measure::{Measurement, Outcome};
use crate::run::Record;

/// Records of one model and check, in the order in which the pair was first met.
pub(super) fn groups(records: &[Record]) -> Vec<Vec<&Record>> {
    let mut groups: Vec<Vec<&Record>> = Vec::new();
    for record in records {
        let known =
            groups.iter_mut().find(|g| g[0].model == record.model && g[0].check == record.check);
        match known {
            Some(group) => group.push(record),
            None => groups.push(vec![record]),
        }
    }
    groups
}

/// The measurement nearest to its bound or furthest beyond, or why there is none.
pub(super) fn worst_of<'a>(group: &[&'a Record]) -> Result<&'a Measurement, &'static str> {
    let mut found = Err("");
    let mut severity = f64::NEG_INFINITY;
    for record in group {
        match &record.outcome {
            Outcome::NotApplicable(reason) => {
                if found.is_err() {
                    found = Err(*reason);
                }
            }
            Outcome::Measured(m) => {
                let this = if m.passed() {
                    m.worst / m.bound.max(f64::MIN_POSITIVE)
                } else {
                    f64::INFINITY
                };
                if this > severity || found.is_err() {
                    (found, severity) = (Ok(m), this);
                }
            }
        }
    }
    found
}
