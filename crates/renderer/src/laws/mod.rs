//! Laws that pictures obey, checked on small scenes.

mod depth;
mod determinism;
mod direct_light;
mod furnace;
mod health;
mod scenes;
mod strategies;
