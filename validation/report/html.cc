#include "validation/report/html.h"

#include "validation/report/base64.h"

#include <cstddef>

namespace pelvireg::report
{
std::string escape(const std::string &text)
{
  std::string escaped;
  for (const char character : text)
    switch (character)
    {
    case '&':
      escaped += "&amp;";
      break;
    case '<':
      escaped += "&lt;";
      break;
    case '>':
      escaped += "&gt;";
      break;
    case '"':
      escaped += "&quot;";
      break;
    case '\'':
      escaped += "&#39;";
      break;
    default:
      escaped += character;
    }
  return escaped;
}

std::string table(const std::vector<std::string> &heading, const std::vector<std::vector<std::string>> &rows)
{
  std::string text = "<div class=\"scroll\"><table><thead><tr>";
  for (const std::string &cell : heading)
    text += "<th scope=\"col\">" + escape(cell) + "</th>";
  text += "</tr></thead><tbody>\n";
  for (const std::vector<std::string> &row : rows)
  {
    text += "<tr>";
    for (std::size_t i = 0; i < heading.size(); ++i)
    {
      const std::string cell = i < row.size() ? escape(row[i]) : "";
      text += i == 0 ? "<th scope=\"row\">" + cell + "</th>" : "<td>" + cell + "</td>";
    }
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

std::string section(const std::string &id, const std::string &title, const std::string &body)
{
  return "<section id=\"" + escape(id) + "\">\n<h2>" + escape(title) + "</h2>\n" + body + "</section>\n";
}

std::string details(const std::string &summary, const std::string &body)
{
  return "<details><summary>" + escape(summary) + "</summary>\n" + body + "</details>\n";
}

std::string jpeg_data_url(const std::string &bytes)
{
  if (bytes.rfind("\xFF\xD8\xFF", 0) != 0)
    return "";
  return "data:image/jpeg;base64," + base64(bytes);
}

std::string svg_data_url(const std::string &text)
{
  return "data:image/svg+xml;base64," + base64(text);
}
} // namespace pelvireg::report
