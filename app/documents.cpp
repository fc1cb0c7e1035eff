#include "documents.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace {

std::vector<const CLI::App*> commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

/// Options without those that --help does not show; positional arguments first.
std::vector<const CLI::Option*> options(const CLI::App& app) {
  std::vector<const CLI::Option*> all =
      app.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
  std::stable_partition(all.begin(), all.end(),
                        [](const CLI::Option* option) { return option->get_positional(); });
  return all;
}

/// Text as roff shows it: no requests, no escapes, hyphens that can be copied.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n'))
      out += "\\&";
    if (c == '\\')
      out += "\\e";
    else
      out += c == '-' ? std::string("\\-") : std::string(1, c);
  }
  return out;
}

std::string item(const CLI::Option& option) {
  std::string text =
      fmt::format(".TP\n.B {}\n{}", roff(option.get_name(option.get_positional(), true)),
                  roff(option.get_description()));
  if (!option.get_default_str().empty())
    text += roff(fmt::format(" (default: {})", option.get_default_str()));
  return text + "\n";
}

std::string section(const CLI::App& command) {
  std::string text = fmt::format(".SS ventricle {}\n{}.\n", roff(command.get_name()),
                                 roff(command.get_description()));
  for (const CLI::Option* option : options(command))
    text += item(*option);
  return text;
}

/// Names that start with a hyphen, as bash's compgen wants them.
std::string flags(const CLI::App& command) {
  std::string words;
  for (const CLI::Option* option : options(command))
    for (const std::string& name : option->get_lnames())
      words += (words.empty() ? "--" : " --") + name;
  return words;
}

}  // namespace

std::string man_page(const CLI::App& app, const std::string& version,
                     const std::string& parameters) {
  const std::string what = app.get_description();  // "ventricle: ..."
  std::string text = fmt::format(
      ".TH VENTRICLE 1 \"\" \"ventricle {}\"\n.SH NAME\n{}\n.SH SYNOPSIS\n.B ventricle\nCOMMAND "
      "...\n"
      ".SH OPTIONS\n",
      roff(version), roff("ventricle - " + what.substr(what.find(' ') + 1)));
  for (const CLI::Option* option : options(app))
    text += item(*option);
  text += ".SH COMMANDS\n";
  for (const CLI::App* command : commands(app))
    text += section(*command);
  return text +
         ".SH EXIT STATUS\n0: done; 1: wrong input or a failed verification; 2: a run that could "
         "not go on;\n"
         "3: a defect of the program; 130: interrupted, with a checkpoint.\n"
         ".SH PARAMETERS OF A CASE FILE\n.nf\n" +
         roff(parameters) + ".fi\n";
}

std::string bash_completion(const CLI::App& app) {
  std::string names;
  std::string cases;
  for (const CLI::App* command : commands(app)) {
    names += command->get_name() + " ";
    cases += fmt::format("    {}) words=\"{}\" ;;\n", command->get_name(), flags(*command));
  }
  return fmt::format(R"(# bash completion for ventricle
_ventricle() {{
  local words="" current=${{COMP_WORDS[COMP_CWORD]}}
  case ${{COMP_WORDS[1]}} in
{}  esac
  [ "$COMP_CWORD" -gt 1 ] || words="{}{}"
  [ "$COMP_CWORD" = 1 ] || [[ $current == -* ]] || words=""
  COMPREPLY=($(compgen -W "$words" -- "$current"))
}}
complete -o default -F _ventricle ventricle
)",
                     cases, names, flags(app));
}
