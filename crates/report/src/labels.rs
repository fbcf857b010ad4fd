//! Places for labels, so that none covers another.

/// A rectangle `[left, top, right, bottom]`.
type Rectangle = [f64; 4];

/// Labels placed so far, and what else they should not cover.
#[derive(Debug)]
pub(crate) struct Labels {
    frame: Rectangle,
    taken: Vec<Rectangle>,
}

/// Height of a line of small text, and the mean width of its letters.
const LINE: f64 = 12.0;
const LETTER: f64 = 5.6;
/// How far a label stands from its point.
const GAP: f64 = 7.0;

impl Labels {
    /// No label yet in a frame.
    pub(crate) fn new(frame: Rectangle) -> Self {
        Self { frame, taken: Vec::new() }
    }

    /// Keeps labels off a marker at a point.
    pub(crate) fn avoid(&mut self, [x, y]: [f64; 2]) {
        self.taken.push([x - 4.0, y - 4.0, x + 4.0, y + 4.0]);
    }

    /// The left end of the base line of `text` beside a point: right of it, left, above, below, then further up and down.
    /// `None` where all these places are taken.
    pub(crate) fn place(&mut self, [x, y]: [f64; 2], text: &str) -> Option<[f64; 2]> {
        let width = LETTER * text.chars().count() as f64;
        let beside = [x + GAP, x - GAP - width];
        let centred = x - 0.5 * width;
        let near = beside.map(|left| [left, y + 4.0]).into_iter();
        let over = [-8.0, 16.0].map(|dy| [centred, y + dy]).into_iter();
        let shifted = (1..=3).flat_map(|k| {
            let dy = LINE * f64::from(k);
            beside.into_iter().flat_map(move |left| [[left, y + 4.0 - dy], [left, y + 4.0 + dy]])
        });
        let place = near.chain(over).chain(shifted).find(|&[left, base]| {
            let box_ = [left, base - 9.0, left + width, base + 2.0];
            self.is_free(box_)
        })?;
        self.taken.push([place[0], place[1] - 9.0, place[0] + width, place[1] + 2.0]);
        Some(place)
    }

    fn is_free(&self, [left, top, right, bottom]: Rectangle) -> bool {
        let [l, t, r, b] = self.frame;
        let inside = left >= l && top >= t && right <= r && bottom <= b;
        inside
            && !self
                .taken
                .iter()
                .any(|o| left < o[2] && o[0] < right && top < o[3] && o[1] < bottom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_of_coinciding_points_stand_apart_until_there_is_no_place() {
        let mut labels = Labels::new([0.0, 0.0, 200.0, 100.0]);
        labels.avoid([100.0, 50.0]);
        let places: Vec<_> = (0..40).map_while(|_| labels.place([100.0, 50.0], "abc")).collect();
        assert!((4..40).contains(&places.len()), "{places:?}");
        for (i, a) in places.iter().enumerate() {
            for b in &places[..i] {
                let apart = (a[1] - b[1]).abs() >= 11.0 || (a[0] - b[0]).abs() >= 3.0 * LETTER;
                assert!(apart, "{a:?} {b:?}");
            }
        }
    }
}
