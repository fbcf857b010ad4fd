//! Where the parts of a scene are described.

use alloc::collections::BTreeMap;
use alloc::format;
use alloc::string::String;
use core::fmt;

use crate::Location;
use crate::effect::Element;
use crate::printable::printable;
use crate::xml::Node;

/// Where a part of a scene is described.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Origin {
    /// The element of the file with its plugin.
    pub element: String,
    /// File, line and column.
    pub location: Location,
}

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} at {}", self.element, self.location)
    }
}

/// Where each part of a scene is described; what nobody wrote, such as the light around a bare mesh, has no place.
#[derive(Clone, Debug, Default)]
pub struct Origins {
    places: BTreeMap<Element, Origin>,
}

impl Origins {
    /// Where an element is described.
    pub fn of(&self, element: Element) -> Option<&Origin> {
        self.places.get(&element)
    }

    /// Notes the node that describes an element; the first counts.
    pub(super) fn note(&mut self, element: Element, node: &Node) {
        let tag = node.kind.tag();
        let (element_name, location) = (format!("{tag} “{}”", node.plugin), node.location.clone());
        self.note_place(element, Origin { element: element_name, location });
    }

    /// Notes where an element is described; the first counts.
    pub(super) fn note_place(&mut self, element: Element, origin: Origin) {
        let element_name = printable(origin.element);
        self.places.entry(element).or_insert(Origin { element: element_name, ..origin });
    }
}
