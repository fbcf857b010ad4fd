//! Where buffers and images are kept.

use alloc::borrow::Cow;
use alloc::string::String;
use alloc::vec::Vec;
use std::path::PathBuf;

use super::base64;
use super::document::Document;
use super::json::Json;
use crate::SceneError;
use crate::load::read_asset;

/// What a URI leads to.
pub(super) enum Resource {
    /// Bytes that are part of the document.
    Data(Vec<u8>),
    /// A file, and what it holds.
    File(PathBuf, Vec<u8>),
}

/// Fetches what a string of the document names: base64 in a `data:` URI, or a file relative to the document.
///
/// # Errors
/// Other schemes, data that is no base64, a file that cannot be read.
pub(super) fn fetch(uri: &Json<'_>, document: &Document) -> Result<Resource, SceneError> {
    let text = uri.as_text()?;
    match scheme(text) {
        Some(scheme) if scheme.eq_ignore_ascii_case("data") => {
            let Some((kind, data)) = text[scheme.len() + 1..].split_once(',') else {
                return Err(uri.error("a “data:” URI without a comma holds no data"));
            };
            if !kind.to_ascii_lowercase().ends_with(";base64") {
                let error = uri.error("a “data:” URI that is not base64 is not supported");
                return Err(error.help("encode its data as base64"));
            }
            match base64::decode(data.as_bytes()) {
                Ok(bytes) => Ok(Resource::Data(bytes)),
                Err(at) => Err(uri.error(alloc::format!(
                    "the base64 data is broken at its byte {at} of {}",
                    data.len()
                ))),
            }
        }
        Some(scheme) => {
            let error = uri.error(alloc::format!("a URI “{scheme}:…” is not supported"));
            Err(error.help("fetch the file and name it relative to the document"))
        }
        None => {
            let name = percent_decoded(text);
            let path = document.file().parent().unwrap_or(document.file()).join(&*name);
            match document.sandbox().check(&path).and_then(|()| read_asset(&path)) {
                Ok(bytes) => Ok(Resource::File(path, bytes)),
                Err(error) => Err(uri.told_of(error)),
            }
        }
    }
}

/// The scheme of an absolute URI. A letter by itself is the drive of a path, which is none.
fn scheme(text: &str) -> Option<&str> {
    let (scheme, _) = text.split_once(':')?;
    let mut characters = scheme.chars();
    let is_scheme = scheme.len() > 1
        && characters.next().is_some_and(|c| c.is_ascii_alphabetic())
        && characters.all(|c| c.is_ascii_alphanumeric() || "+-.".contains(c));
    is_scheme.then_some(scheme)
}

/// `%20` and its like as the bytes they stand for; text that is not such an encoding stays as it is, since many exporters
/// write names as they are.
fn percent_decoded(text: &str) -> Cow<'_, str> {
    if !text.contains('%') {
        return Cow::Borrowed(text);
    }
    let bytes = text.as_bytes();
    let mut decoded = Vec::with_capacity(bytes.len());
    let mut at = 0;
    while let Some(&byte) = bytes.get(at) {
        let digit = |i: usize| bytes.get(i).and_then(|&b| char::from(b).to_digit(16));
        match (byte, digit(at + 1), digit(at + 2)) {
            (b'%', Some(high), Some(low)) => {
                decoded.push((high * 16 + low) as u8);
                at += 3;
            }
            _ => {
                decoded.push(byte);
                at += 1;
            }
        }
    }
    String::from_utf8(decoded).map_or(Cow::Borrowed(text), Cow::Owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_decoded_where_they_are_encoded() {
        for (text, name) in [
            ("a%20b.bin", "a b.bin"),
            ("%C3%A9tendue.png", "étendue.png"),
            ("100%.png", "100%.png"),
            ("%zz%4", "%zz%4"),
            // No UTF-8.
            ("%ff.bin", "%ff.bin"),
        ] {
            assert_eq!(percent_decoded(text), name);
        }
    }

    #[test]
    fn schemes_are_told_from_names() {
        assert_eq!(scheme("https://a/b.bin"), Some("https"));
        assert_eq!(scheme("data:,"), Some("data"));
        for name in ["a.bin", "C:/a.bin", "textures/1:2.png", ":", "a b:c"] {
            assert_eq!(scheme(name), None, "{name}");
        }
    }
}
