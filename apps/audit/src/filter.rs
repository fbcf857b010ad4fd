//! Which part of the audit is run.

/// Names of models and checks, each matched as a part, or of both as `MODEL/CHECK`; none stands for everything.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Filter(Vec<String>);

impl Filter {
    /// Everything whose model or check contains one of the names.
    pub fn new(names: impl IntoIterator<Item = impl Into<String>>) -> Self {
        Self(names.into_iter().map(Into::into).collect())
    }

    /// A check on a model is wanted.
    pub fn wants(&self, model: &str, check: &str) -> bool {
        let wanted = |name: &String| match name.split_once('/') {
            Some((of_model, of_check)) => model.contains(of_model) && check.contains(of_check),
            None => model.contains(name) || check.contains(name),
        };
        self.0.is_empty() || self.0.iter().any(wanted)
    }

    /// The names, for a message.
    pub fn names(&self) -> String {
        self.0.join("', '")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_models_and_of_checks_are_wanted_and_no_name_wants_all() {
        let filter = Filter::new(["rough", "energy"]);
        assert!(filter.wants("rough-conductor", "delta") && filter.wants("lambert", "energy"));
        assert!(!filter.wants("lambert", "delta") && Filter::default().wants("lambert", "delta"));
        let both = Filter::new(["measured/chi"]);
        assert!(both.wants("measured", "chi-square") && !both.wants("measured", "energy"));
        assert!(!both.wants("lambert", "chi-square"));
    }
}
