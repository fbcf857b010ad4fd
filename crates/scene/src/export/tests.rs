//! What is written, and that it reads back.
