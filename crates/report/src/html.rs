//! A report as one page.

use std::fmt::Write;

use crate::report::{Report, Section};
use crate::svg::escaped;
use crate::table::{Cell, Table};

const STYLE: &str = "\
:root{color-scheme:light dark;--page:#fff;--text:#222;--soft:#666;--line:#ddd;--head:#f4f5f7}\
@media(prefers-color-scheme:dark){:root{--page:#16181c;--text:#e4e4e4;--soft:#aaa;--line:#33373f;--head:#1f2228}}\
body{margin:0 auto;max-width:64rem;padding:1rem;background:var(--page);color:var(--text);\
font:16px/1.5 system-ui,sans-serif}h1{font-size:1.6rem}h2{font-size:1.25rem;margin-top:2.5rem}\
dl{display:grid;grid-template-columns:max-content 1fr;gap:.1rem 1rem;color:var(--soft)}dd{margin:0}\
nav ul{columns:14rem;padding-left:1.2rem}a{color:inherit}\
.wide{overflow-x:auto;border:1px solid var(--line);border-radius:.4rem}\
table{border-collapse:collapse;font-size:.9rem;width:100%;font-variant-numeric:tabular-nums}\
th,td{padding:.3rem .6rem;text-align:left;border-bottom:1px solid var(--line);white-space:nowrap}\
th{background:var(--head)}td.number,th.number{text-align:right}tr:last-child td{border-bottom:0}\
.charts{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,26rem),1fr));gap:1rem;margin:1rem 0}\
figure{margin:0}figure svg{width:100%;height:auto;border:1px solid var(--line);border-radius:.4rem}";

/// The page.
pub(crate) fn page(report: &Report) -> String {
    let title = escaped(&report.title);
    let mut text = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>{title}</title>\n\
         <style>{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n"
    );
    // Writing to a string cannot fail, here and below.
    if !report.facts.is_empty() {
        text += "<dl>\n";
        for (name, value) in &report.facts {
            let _ = writeln!(text, "<dt>{}</dt><dd>{}</dd>", escaped(name), escaped(value));
        }
        text += "</dl>\n";
    }
    paragraphs(&mut text, &report.introduction);
    if report.sections.len() > 1 {
        text += "<nav><ul>\n";
        for section in &report.sections {
            let (name, heading) = (escaped(&section.name), escaped(&section.heading));
            let _ = writeln!(text, "<li><a href=\"#{name}\">{heading}</a></li>");
        }
        text += "</ul></nav>\n";
    }
    for part in &report.sections {
        section(&mut text, part);
    }
    text + "</body>\n</html>\n"
}

fn section(text: &mut String, section: &Section) {
    let (name, heading) = (escaped(&section.name), escaped(&section.heading));
    let _ = writeln!(text, "<section id=\"{name}\">\n<h2>{heading}</h2>");
    paragraphs(text, &section.prose);
    if !section.charts.is_empty() {
        *text += "<div class=\"charts\">\n";
        for chart in &section.charts {
            let _ = writeln!(text, "<figure>{}</figure>", chart.svg());
        }
        *text += "</div>\n";
    }
    if !section.table.rows().is_empty() {
        table(text, &section.table);
    }
    paragraphs(text, &section.advice);
    *text += "</section>\n";
}

fn table(text: &mut String, table: &Table) {
    *text += "<div class=\"wide\"><table>\n<thead><tr>";
    for (i, column) in table.columns().iter().enumerate() {
        let class = if table.is_numeric(i) { " class=\"number\"" } else { "" };
        let _ = write!(text, "<th{class}>{}</th>", escaped(&column.heading));
    }
    *text += "</tr></thead>\n<tbody>\n";
    for row in table.rows() {
        *text += "<tr>";
        for (i, cell) in row.iter().enumerate() {
            let class = if table.is_numeric(i) { " class=\"number\"" } else { "" };
            // All digits of a number show on hovering.
            let exact = match cell {
                Cell::Number { value, .. } => format!(" title=\"{value}\""),
                _ => String::new(),
            };
            let _ = write!(text, "<td{class}{exact}>{}</td>", escaped(&cell.shown()));
        }
        *text += "</tr>\n";
    }
    *text += "</tbody></table></div>\n";
}

fn paragraphs(text: &mut String, paragraphs: &[String]) {
    for paragraph in paragraphs {
        let _ = writeln!(text, "<p>{}</p>", escaped(paragraph));
    }
}
