//! Vector pictures: the few elements that plots are made of.

use std::fmt::Write;

/// A picture in user units, one to a CSS pixel, y downwards.
#[derive(Debug)]
pub struct Svg {
    size: [f64; 2],
    body: String,
}

/// Where a text stands relative to its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// To the right of it.
    Start,
    /// Centred on it.
    Middle,
    /// To the left of it.
    End,
}

/// How many colours there are for curves: classes `c0` to `c5`.
pub const COLOURS: usize = 6;
/// How many line patterns there are: classes `p0` to `p3`.
pub const PATTERNS: usize = 4;

/// Okabe and Ito's colours, told apart with any colour vision; brightened on a dark page.
const STYLE: &str = "\
.page{fill:#fff}text{font:12px system-ui,sans-serif;fill:#222}.title{font-weight:600;font-size:13px}\
.small{font-size:10.5px;fill:#555}.curve{fill:none;stroke-width:1.6;stroke-linejoin:round}\
.grid{fill:none;stroke:#ccc;stroke-width:.7}.axis{fill:none;stroke:#555;stroke-width:1}\
.c0{stroke:#0072b2}.c1{stroke:#d55e00}.c2{stroke:#009e73}.c3{stroke:#cc79a7}.c4{stroke:#b8860b}.c5{stroke:#56b4e9}\
.p1{stroke-dasharray:7 3}.p2{stroke-dasharray:2 2.5}.p3{stroke-dasharray:8 3 2 3}\
.delta{stroke-width:2.4}.viewer{stroke:#555;stroke-width:1}.guide{stroke:#888;stroke-width:1;stroke-dasharray:4 4}\
.marker{stroke-width:1.6}.hollow{fill:#fff}.c0.filled{fill:#0072b2}.c1.filled{fill:#d55e00}.c2.filled{fill:#009e73}\
.c3.filled{fill:#cc79a7}.c4.filled{fill:#b8860b}.c5.filled{fill:#56b4e9}\
@media(prefers-color-scheme:dark){.page{fill:#16181c}text{fill:#e4e4e4}.small{fill:#aaa}.grid{stroke:#3a3d44}\
.axis,.viewer{stroke:#aaa}.c0{stroke:#4aa8e0}.c1{stroke:#ff8c42}.c2{stroke:#2fc79a}.c3{stroke:#e0a0c4}\
.c4{stroke:#e0b040}.c5{stroke:#8fd0f5}.hollow{fill:#16181c}.c0.filled{fill:#4aa8e0}.c1.filled{fill:#ff8c42}\
.c2.filled{fill:#2fc79a}.c3.filled{fill:#e0a0c4}.c4.filled{fill:#e0b040}.c5.filled{fill:#8fd0f5}}";

impl Svg {
    /// An empty picture of `[width, height]`.
    pub fn new(size: [f64; 2]) -> Self {
        Self { size, body: String::new() }
    }

    /// A straight line.
    pub fn line(&mut self, class: &str, [x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) {
        self.element(format_args!(
            r#"<line class="{class}" x1="{x0:.2}" y1="{y0:.2}" x2="{x1:.2}" y2="{y1:.2}"/>"#
        ));
    }

    /// A polyline, without the points that lie on top of their predecessor at the precision of the file.
    pub fn polyline(&mut self, class: &str, points: impl IntoIterator<Item = [f64; 2]>) {
        let mut list = String::new();
        let mut last = String::new();
        for [x, y] in points {
            let point = format!("{x:.1},{y:.1} ");
            if point != last {
                list.push_str(&point);
                last = point;
            }
        }
        self.element(format_args!(r#"<polyline class="{class}" points="{}"/>"#, list.trim_end()));
    }

    /// The part of a circle that lies above its centre, or all of it.
    pub fn arc(&mut self, class: &str, [x, y]: [f64; 2], r: f64, extent: Extent) {
        match extent {
            Extent::Whole => self.element(format_args!(
                r#"<circle class="{class}" cx="{x:.2}" cy="{y:.2}" r="{r:.2}"/>"#
            )),
            Extent::UpperHalf => self.element(format_args!(
                r#"<path class="{class}" d="M{:.2} {y:.2}A{r:.2} {r:.2} 0 0 1 {:.2} {y:.2}"/>"#,
                x - r,
                x + r
            )),
        }
    }

    /// A line of text.
    pub fn text(&mut self, class: &str, [x, y]: [f64; 2], anchor: Anchor, content: &str) {
        let anchor = anchor.name();
        let content = escaped(content);
        self.element(format_args!(
            r#"<text class="{class}" x="{x:.2}" y="{y:.2}" text-anchor="{anchor}">{content}</text>"#
        ));
    }

    /// A round marker whose tooltip is `title`.
    pub fn marker(&mut self, class: &str, [x, y]: [f64; 2], title: &str) {
        let title = escaped(title);
        self.element(format_args!(
            r#"<circle class="{class}" cx="{x:.2}" cy="{y:.2}" r="3.6"><title>{title}</title></circle>"#
        ));
    }

    /// A text that reads upwards, centred on its point.
    pub fn upward_text(&mut self, class: &str, [x, y]: [f64; 2], content: &str) {
        let content = escaped(content);
        self.element(format_args!(
            r#"<text class="{class}" transform="translate({x:.2} {y:.2}) rotate(-90)" text-anchor="middle">{content}</text>"#
        ));
    }

    /// The file.
    pub fn finish(self, title: &str) -> String {
        let ([w, h], title) = (self.size, escaped(title));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" \
             role=\"img\">\n<title>{title}</title>\n<style>{STYLE}</style>\n\
             <rect class=\"page\" width=\"{w}\" height=\"{h}\"/>\n{}</svg>\n",
            self.body
        )
    }

    fn element(&mut self, element: std::fmt::Arguments<'_>) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.body, "{element}");
    }
}

/// How much of a circle is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// The half above its centre.
    UpperHalf,
    /// All of it.
    Whole,
}

impl Anchor {
    fn name(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Middle => "middle",
            Self::End => "end",
        }
    }
}

/// Pictures one below the other, each as wide as the widest.
pub fn stacked(title: &str, pictures: &[String]) -> String {
    let size = |picture: &str| -> [f64; 2] {
        let number = |name: &str| {
            let rest = picture.split(&format!(" {name}=\"")).nth(1)?;
            rest.split('"').next()?.parse().ok()
        };
        ["width", "height"].map(|name| number(name).unwrap_or(0.0))
    };
    let width = pictures.iter().map(|p| size(p)[0]).fold(1.0, f64::max);
    let mut svg = Svg::new([width, pictures.iter().map(|p| size(p)[1]).sum::<f64>().max(1.0)]);
    let mut top = 0.0;
    for picture in pictures {
        svg.body += &picture.replacen("<svg ", &format!("<svg y=\"{top}\" "), 1);
        top += size(picture)[1];
    }
    svg.finish(title)
}

/// A text in which nothing is taken for markup.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_cannot_break_out_of_its_element() {
        let mut svg = Svg::new([10.0, 10.0]);
        svg.text("small", [1.0, 2.0], Anchor::End, "a<b>&\"c\"");
        let file = svg.finish("<x>");
        assert!(file.contains(">a&lt;b&gt;&amp;&quot;c&quot;</text>"));
        assert!(file.contains("<title>&lt;x&gt;</title>"));
    }

    #[test]
    fn coinciding_points_are_written_once() {
        let mut svg = Svg::new([10.0, 10.0]);
        svg.polyline("curve", [[0.0, 0.0], [0.001, 0.0], [1.0, 0.0]]);
        assert!(svg.body.contains(r#"points="0.0,0.0 1.0,0.0""#), "{}", svg.body);
    }
}
