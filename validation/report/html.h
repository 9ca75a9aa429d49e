// The few pieces of HTML that the report is made of.
#pragma once

#include <string>
#include <vector>

namespace pelvireg::report
{
/// Text made safe for element content and double-quoted attributes.
std::string escape(const std::string &text);

/// A table in a box that scrolls sideways on narrow screens. The first cell of each row is its heading. Cells are
/// escaped; rows shorter than the heading are filled up.
std::string table(const std::vector<std::string> &heading, const std::vector<std::vector<std::string>> &rows);

/// A part of the page with a heading, and an id to jump to. `title` is escaped, `body` is HTML.
std::string section(const std::string &id, const std::string &title, const std::string &body);

/// Closed until the reader opens it. `summary` is escaped, `body` is HTML.
std::string details(const std::string &summary, const std::string &body);

/// Bytes of a JPEG file as a data: URL. Empty when they do not begin like one.
std::string jpeg_data_url(const std::string &bytes);

/// An SVG file's text as a data: URL: as an image it runs no script and asks for nothing.
std::string svg_data_url(const std::string &text);
} // namespace pelvireg::report
