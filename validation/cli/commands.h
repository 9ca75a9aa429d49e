// The words of the command line. Each function adds a group of commands to the program.
#pragma once

#include "validation/cli/register_stage.h"
#include "validation/cli/stages.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

namespace pelvireg::cli
{
/// What the command line asks for.
struct Invocation
{
  std::string command_line;     ///< as typed, for the manifest
  std::function<void()> action; ///< set by the command that was given
  int status = 0;               ///< exit status, set by the action when it has more to say than that it is done
};

void add_case_commands(CLI::App &program, Invocation &invocation);     ///< cases, anatomy
void add_stage_commands(CLI::App &program, Invocation &invocation);    ///< reference, observe, evaluate, report
void add_images_command(CLI::App &program, Invocation &invocation);    ///< images
void add_track_command(CLI::App &program, Invocation &invocation);     ///< track
void add_register_commands(CLI::App &program, Invocation &invocation); ///< register, merge
void add_run_command(CLI::App &program, Invocation &invocation);       ///< run
void add_study_commands(CLI::App &program, Invocation &invocation);    ///< mesh-study, cavity-study
void add_export_command(CLI::App &program, Invocation &invocation);    ///< export
void add_import_command(CLI::App &program, Invocation &invocation);    ///< import
void add_compare_command(CLI::App &program, Invocation &invocation);   ///< compare
void add_baseline_command(CLI::App &program, Invocation &invocation);  ///< baseline propose, baseline accept

/// The name of a case in files: a built-in name as it is, a path without folder and extension.
std::string case_label(const std::string &name_or_path);

/// "--jobs N", at most the machine's threads by default.
void add_jobs_option(CLI::App &command, int &jobs);
/// "--samples N --seed N --perturb KIND" and the magnitudes of each kind
void add_sample_options(CLI::App &command, SampleSettings &settings);
/// "--condition NAME", any number of times or with commas; "all" stands for every one
void add_condition_option(CLI::App &command, std::vector<std::string> &conditions);
/// With "all" replaced by every condition, each once.
std::vector<std::string> expanded_conditions(const std::vector<std::string> &given);

/// error_table.txt and condition_table.txt on standard output.
void print_error_table(const ResultDirectory &directory);
} // namespace pelvireg::cli
