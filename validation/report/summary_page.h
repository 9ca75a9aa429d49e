// The result on one page of paper.
#pragma once

#include "validation/report/report.h"

#include <string>

namespace pelvireg::report
{
/// One A4 page as HTML without script: verdict, error table, claims, error curves, the image plane, provenance.
std::string summary_page_html(const ReportInputs &inputs);
} // namespace pelvireg::report
