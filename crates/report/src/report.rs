//! What an experiment says of itself.

use serde_json::{Value, json};

use crate::chart::Chart;
use crate::html;
use crate::table::Table;

/// The outcome of an experiment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// What was done.
    pub title: String,
    /// Circumstances as name and value: date, machine, version, seed, settings.
    pub facts: Vec<(String, String)>,
    /// Paragraphs before the sections.
    pub introduction: Vec<String>,
    /// Its parts.
    pub sections: Vec<Section>,
}

/// One part of a report.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Section {
    /// Its name for programs and in addresses: lower-case words joined by hyphens, unique in the report.
    pub name: String,
    /// Its heading.
    pub heading: String,
    /// Paragraphs before the table.
    pub prose: Vec<String>,
    /// What was measured.
    pub table: Table,
    /// The same as pictures.
    pub charts: Vec<Chart>,
    /// Paragraphs after the charts: what to make of it.
    pub advice: Vec<String>,
}

impl Report {
    /// Everything as JSON: `{"title", "facts": {…}, "sections": {name: {"heading", "rows": […]}}}`.
    pub fn json(&self) -> Value {
        let facts = self.facts.iter().map(|(name, value)| (name.clone(), json!(value)));
        let sections = self.sections.iter().map(|section| {
            let content = json!({ "heading": section.heading, "rows": section.table.json() });
            (section.name.clone(), content)
        });
        json!({
            "title": self.title,
            "facts": Value::Object(facts.collect()),
            "sections": Value::Object(sections.collect()),
        })
    }

    /// All tables as CSV: the column `section` first, a line of headings before each table whose columns differ from
    /// those of the one before.
    pub fn csv(&self) -> String {
        let mut text = String::new();
        let mut headings = String::new();
        for section in &self.sections {
            let lines = section.table.csv(&[("section", &section.name)]);
            let (first, rest) = lines.split_once('\n').unwrap_or((&lines, ""));
            if first != headings {
                if !text.is_empty() {
                    text.push('\n');
                }
                text += first;
                text.push('\n');
                first.clone_into(&mut headings);
            }
            text += rest;
        }
        text
    }

    /// The sections as Markdown, from headings of the second level; charts as pictures beside the document, whose address
    /// `picture` gives for a section's name and the chart's number.
    pub fn markdown(&self, picture: impl Fn(&str, usize) -> String) -> String {
        let mut text = String::new();
        let paragraph = |text: &mut String, content: &str| {
            text.push_str(content.trim_end());
            text.push_str("\n\n");
        };
        for (name, value) in &self.facts {
            text += &format!("* {name}: {value}\n");
        }
        if !self.facts.is_empty() {
            text.push('\n');
        }
        for content in &self.introduction {
            paragraph(&mut text, content);
        }
        for section in &self.sections {
            paragraph(&mut text, &format!("## {}", section.heading));
            for content in &section.prose {
                paragraph(&mut text, content);
            }
            if !section.table.rows().is_empty() {
                paragraph(&mut text, &section.table.markdown());
            }
            for (i, chart) in section.charts.iter().enumerate() {
                let address = picture(&section.name, i);
                paragraph(&mut text, &format!("![{}]({address})", chart.title));
            }
            for content in &section.advice {
                paragraph(&mut text, content);
            }
        }
        text
    }

    /// One HTML page that needs nothing else: tables, charts, styles for light and dark pages and for narrow ones.
    pub fn html(&self) -> String {
        html::page(self)
    }

    /// All charts in one SVG file, one below the other.
    pub fn svg(&self) -> String {
        let charts: Vec<String> =
            self.sections.iter().flat_map(|s| &s.charts).map(Chart::svg).collect();
        crate::svg::stacked(&self.title, &charts)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::Cell;
    use crate::{Axis, Point, Series, Style};

    fn section(name: &str, column: &'static str) -> Section {
        let mut table = Table::new([(column, column)]);
        table.push([Cell::number(0.5)]);
        let points = vec![Point { at: [1.0, 2.0], ..Point::default() }];
        let series = vec![Series { name: String::new(), style: Style::Markers, points }];
        let [x, y] = ["x", "y"].map(Axis::log);
        let chart = Chart { title: "<t>".to_owned(), x, y, series, guides: Vec::new() };
        let heading = format!("Section {name}");
        Section { name: name.to_owned(), heading, table, charts: vec![chart], ..Section::default() }
    }

    fn report() -> Report {
        Report {
            title: "A & B".to_owned(),
            facts: vec![("seed".to_owned(), "1".to_owned())],
            introduction: vec!["First <b>.".to_owned()],
            sections: vec![section("a", "p"), section("b", "p"), section("c", "q")],
        }
    }

    #[test]
    fn headings_of_csv_are_repeated_only_where_columns_change() {
        assert_eq!(report().csv(), "section,p\na,0.5\nb,0.5\n\nsection,q\nc,0.5\n");
    }

    #[test]
    fn json_holds_every_section_by_name() {
        assert_eq!(report().json()["sections"]["c"]["rows"][0]["q"], 0.5);
        assert_eq!(report().json()["facts"]["seed"], "1");
    }

    #[test]
    fn the_page_and_the_stack_hold_every_chart_and_no_text_is_taken_for_markup() {
        let page = report().html();
        assert_eq!(page.matches("<svg").count(), 3);
        assert!(page.contains("<h1>A &amp; B</h1>") && page.contains("First &lt;b&gt;."));
        assert!(!page.contains("http://") || !page.contains("src="), "no address of the network");
        let stack = report().svg();
        assert_eq!(stack.matches("<svg").count(), 4);
        assert!(report().markdown(|name, i| format!("{name}-{i}.svg")).contains("![<t>](b-0.svg)"));
    }
}
