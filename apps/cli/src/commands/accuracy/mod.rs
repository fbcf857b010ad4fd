//! `etendue accuracy`: what accuracy costs in time.

mod report_files;
