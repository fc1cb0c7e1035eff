#pragma once

#include <CLI/CLI.hpp>

#include <string>

/// What is made of the declarations that --help prints: never written by hand, never out of date.

/// The manual page ventricle(1), in roff; `parameters` is the list of all parameters of a case
/// file.
[[nodiscard]] std::string man_page(const CLI::App& app, const std::string& version,
                                   const std::string& parameters);

/// A script for bash that completes commands, options and names of files.
[[nodiscard]] std::string bash_completion(const CLI::App& app);
