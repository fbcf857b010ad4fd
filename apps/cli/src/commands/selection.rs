//! Arguments of commands that can leave effects out.

use std::collections::BTreeSet;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use etendue_scene::{Effect, Scene};

/// Which of the effects that a scene calls for are simulated.
#[derive(Debug, clap::Args)]
pub(crate) struct SelectionArguments {
    /// Leave effects out, separated by commas; `etendue effects` lists those that a scene calls for.
    #[arg(long, value_name = "EFFECT", value_delimiter = ',', hide_possible_values = true, value_parser = effects())]
    without: Vec<Effect>,
    /// Simulate these effects only, separated by commas.
    #[arg(long, value_name = "EFFECT", value_delimiter = ',', hide_possible_values = true, conflicts_with = "without", value_parser = effects())]
    only: Vec<Effect>,
}

impl SelectionArguments {
    /// The effects that are left out, whether a scene calls for them or not.
    pub(crate) fn left_out(&self) -> BTreeSet<Effect> {
        let is_left_out = |effect: &Effect| {
            self.without.contains(effect) || !self.only.is_empty() && !self.only.contains(effect)
        };
        Effect::ALL.into_iter().filter(is_left_out).collect()
    }

    /// The scene with what is simulated of it.
    pub(crate) fn select(&self, scene: Scene) -> Scene {
        let left_out = self.left_out();
        if left_out.is_empty() { scene } else { scene.without(&left_out) }
    }
}

/// Effects by name.
fn effects() -> impl TypedValueParser<Value = Effect> {
    let names = Effect::ALL.map(|effect| PossibleValue::new(effect.name()));
    PossibleValuesParser::new(names).try_map(|name| {
        let named = Effect::ALL.into_iter().find(|effect| effect.name() == name);
        named.ok_or("no such effect")
    })
}
