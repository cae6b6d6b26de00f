#pragma once

#include <ostream>
#include <string>

namespace spring_workbench::benchmark {

/// `text` without markup.
std::string escaped(const std::string& text);

/// RFC 4648.
std::string base64(const std::string& bytes);

/// A table from CSV, header line first; cells may be quoted. A cell "PASS" or "FAIL" is coloured.
void add_table(const std::string& csv, std::ostream& out);

/// A table that opens on a click.
void add_folded_table(const std::string& title, const std::string& csv, std::ostream& out);

/// A PNG file as part of the page; nothing where `path` is empty.
void add_picture(const std::string& path, const std::string& caption, std::ostream& out);

}  // namespace spring_workbench::benchmark
