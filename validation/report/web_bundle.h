// Script, style and licences of the page, bundled from web/ when the program is built.
#pragma once

#include <string_view>

namespace pelvireg::report
{
std::string_view page_script();
std::string_view page_script_digest(); ///< base64 of its SHA-256, for the page's Content-Security-Policy
std::string_view page_style();
std::string_view page_licences(); ///< of the libraries inside page_script()
} // namespace pelvireg::report
