// Bytes as text (RFC 4648), for data inside a page.
#pragma once

#include <string>
#include <string_view>

namespace pelvireg::report
{
/// With padding, in one line.
std::string base64(std::string_view bytes);
} // namespace pelvireg::report
