// Identifiers that depend on content alone.
#pragma once

#include <string>

namespace pelvireg::observation
{
/// A DICOM UID of at most 44 characters: "2.25." and the decimal value of a UUID of version 8 (RFC 9562) made from the
/// first 128 bits of the text's SHA-256.
std::string content_uid(const std::string &text);
} // namespace pelvireg::observation
