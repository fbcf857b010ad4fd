//! The files that a report is written to.

use std::path::{Path, PathBuf};

use etendue_report::Report;
use etendue_report::document::with_part;

use crate::failure::{Exit, Failure};
use crate::output::Destination;

/// Where the outcome goes besides the terminal.
#[derive(Debug, clap::Args)]
pub(crate) struct ReportArguments {
    /// Write all figures as JSON.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write all tables as CSV.
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write all plots as one SVG picture.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Write everything as one page that needs no network.
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Write everything into this document, between its lines `<!-- begin NAME -->` and `<!-- end NAME -->` with the name
    /// of the experiment; plots beside it into `images/accuracy`.
    #[arg(long, value_name = "FILE")]
    markdown: Option<PathBuf>,
}

/// Files that can be written, found out before hours of measuring.
pub(crate) struct ReportFiles {
    json: Option<Destination>,
    csv: Option<Destination>,
    svg: Option<Destination>,
    html: Option<Destination>,
    markdown: Option<Document>,
}

struct Document {
    destination: Destination,
    text: String,
}

impl ReportArguments {
    /// Checks every file; `part` is the name of the experiment in the document.
    pub(crate) fn check(&self, part: &str) -> Result<ReportFiles, Failure> {
        self.check_names()?;
        let check = |path: &Option<PathBuf>| path.as_deref().map(Destination::check).transpose();
        Ok(ReportFiles {
            json: check(&self.json)?,
            csv: check(&self.csv)?,
            svg: check(&self.svg)?,
            html: check(&self.html)?,
            markdown: self
                .markdown
                .as_deref()
                .map(|path| Document::open(path, part))
                .transpose()?,
        })
    }

    /// Two outputs into one file would leave the second.
    fn check_names(&self) -> Result<(), Failure> {
        let files = [
            ("--json", &self.json),
            ("--csv", &self.csv),
            ("--svg", &self.svg),
            ("--html", &self.html),
            ("--markdown", &self.markdown),
        ];
        for (i, (option, path)) in files.iter().enumerate() {
            let same = |(_, other): &&(&str, &Option<PathBuf>)| path.is_some() && other == path;
            if let (Some((other, _)), Some(path)) = (files[..i].iter().find(same), path) {
                let path = path.display();
                return Err(Failure::usage(format!("{other} and {option} both name {path}")));
            }
        }
        Ok(())
    }
}

impl ReportFiles {
    /// Prints the tables and writes the files.
    pub(crate) fn write(&self, report: &Report, part: &str) -> Result<(), Failure> {
        println!("{}", report.markdown(|name, i| format!("{name}-{i}.svg")));
        let files = [
            (&self.json, format!("{:#}\n", report.json())),
            (&self.csv, report.csv()),
            (&self.svg, report.svg()),
            (&self.html, report.html()),
        ];
        for (destination, content) in &files {
            if let Some(destination) = destination {
                destination.write(content.as_bytes())?;
            }
        }
        self.markdown.as_ref().map_or(Ok(()), |document| document.write(report, part))
    }
}

impl Document {
    fn open(path: &Path, part: &str) -> Result<Self, Failure> {
        let read = |error| Failure::new(Exit::InputOutput, format!("{}: {error}", path.display()));
        let text = std::fs::read_to_string(path).map_err(read)?;
        with_part(&text, part, "").map_err(|missing| {
            Failure::new(Exit::InputOutput, format!("{}: {missing}", path.display()))
        })?;
        Ok(Self { destination: Destination::check(path)?, text })
    }

    fn write(&self, report: &Report, part: &str) -> Result<(), Failure> {
        const FOLDER: &str = "images/accuracy";
        let name = |section: &str, i: usize| match i {
            0 => format!("{FOLDER}/{part}-{section}.svg"),
            _ => format!("{FOLDER}/{part}-{section}-{}.svg", i + 1),
        };
        let beside = self.destination.path().parent().unwrap_or(Path::new(""));
        let folder = beside.join(FOLDER);
        std::fs::create_dir_all(&folder).map_err(|error| {
            Failure::new(Exit::InputOutput, format!("{}: {error}", folder.display()))
        })?;
        for section in &report.sections {
            for (i, chart) in section.charts.iter().enumerate() {
                let picture = beside.join(name(&section.name, i));
                Destination::check(&picture)?.write(chart.svg().as_bytes())?;
            }
        }
        let text = with_part(&self.text, part, &report.markdown(name))
            .map_err(|missing| Failure::new(Exit::InputOutput, missing.to_string()))?;
        self.destination.write(text.as_bytes())
    }
}
