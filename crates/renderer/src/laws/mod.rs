//! Laws that pictures obey, checked on small scenes.

mod accumulation;
mod accuracy;
mod bias;
mod continuation;
mod depth;
mod determinism;
mod direct_light;
mod features;
mod furnace;
mod health;
mod media;
mod motion;
mod nesting;
mod replay;
mod reuse;
mod scenes;
mod spectral;
mod strategies;
mod transport;
