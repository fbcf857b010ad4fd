//! Path tracing of étendue scenes.
