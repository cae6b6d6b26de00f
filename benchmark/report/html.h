#pragma once

#include <ostream>
#include <string>

namespace spring_workbench::benchmark {

/// Escapes `text` for HTML.
std::string escaped(const std::string& text);

/// Base64 encoding (RFC 4648).
std::string base64(const std::string& bytes);

/// Writes a table from CSV with a header line; cells may be quoted. "PASS" and "FAIL" are coloured.
void add_table(const std::string& csv, std::ostream& out);

/// Writes a table that opens on a click.
void add_folded_table(const std::string& title, const std::string& csv, std::ostream& out);

/// Embeds a PNG file in the page; nothing if `path` is empty.
void add_picture(const std::string& path, const std::string& caption, std::ostream& out);

}  // namespace spring_workbench::benchmark
