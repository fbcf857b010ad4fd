//! Loaders for the files a scene refers to.
