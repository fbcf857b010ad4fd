//! XML.

use alloc::string::String;
use alloc::vec::Vec;

/// An element with its attributes in order and what is inside.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Element {
    tag: &'static str,
    attributes: Vec<(&'static str, String)>,
    children: Vec<Element>,
}

impl Element {
    pub(super) fn new(tag: &'static str) -> Self {
        Self { tag, attributes: Vec::new(), children: Vec::new() }
    }

    /// A plugin.
    pub(super) fn plugin(tag: &'static str, kind: &str) -> Self {
        Self::new(tag).attribute("type", kind)
    }

    /// A parameter and its value.
    pub(super) fn value(tag: &'static str, name: &str, value: impl Into<String>) -> Self {
        Self::new(tag).attribute("name", name).attribute("value", value)
    }

    /// A plugin that is described elsewhere.
    pub(super) fn reference(id: &str) -> Self {
        Self::new("ref").attribute("id", id)
    }

    pub(super) fn attribute(mut self, name: &'static str, value: impl Into<String>) -> Self {
        self.attributes.push((name, value.into()));
        self
    }

    /// The same as the parameter `name` of what it stands in.
    pub(super) fn named(mut self, name: &str) -> Self {
        self.attributes.insert(0, ("name", name.into()));
        self
    }

    /// The same with something inside.
    pub(super) fn with(mut self, child: Self) -> Self {
        self.children.push(child);
        self
    }

    /// The same with all of these inside.
    pub(super) fn with_all(mut self, children: impl IntoIterator<Item = Self>) -> Self {
        self.children.extend(children);
        self
    }

    /// Its text, `depth` levels deep.
    pub(super) fn write(&self, depth: usize, text: &mut String) {
        let indent = |text: &mut String| (0..depth).for_each(|_| text.push_str("    "));
        indent(text);
        text.push('<');
        text.push_str(self.tag);
        for (name, value) in &self.attributes {
            text.push(' ');
            text.push_str(name);
            text.push_str("=\"");
            text.push_str(&escape(value));
            text.push('"');
        }
        if self.children.is_empty() {
            text.push_str("/>\n");
            return;
        }
        text.push_str(">\n");
        for child in &self.children {
            child.write(depth + 1, text);
        }
        indent(text);
        text.push_str("</");
        text.push_str(self.tag);
        text.push_str(">\n");
    }
}

/// Text as the value of an attribute. Characters that XML has no place for are left out; a `$` is one, which
/// [`values::text`](super::values::text) knows to avoid.
fn escape(text: &str) -> String {
    let mut result = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => result.push_str("&amp;"),
            '<' => result.push_str("&lt;"),
            '>' => result.push_str("&gt;"),
            '"' => result.push_str("&quot;"),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => {}
            c => result.push(c),
        }
    }
    result
}

/// Text as a comment, in which no two hyphens follow each other and none stands at the end.
pub(super) fn comment(text: &str) -> String {
    let mut result: String = String::with_capacity(text.len());
    for c in text.chars().filter(|c| !c.is_control() && !matches!(c, '\u{fffe}' | '\u{ffff}')) {
        if c == '-' && result.ends_with('-') {
            result.push(' ');
        }
        result.push(c);
    }
    result
}
