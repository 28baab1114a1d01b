// SPDX-License-Identifier: BSD-3-Clause
#include "ManPage.h"

#include "Completion.h"
#include "LearningParameters.h"

#include <CLI/CLI.hpp>

#include <ostream>

namespace
{
/** As troff takes it: dashes that can be typed, and no line that looks like a request. */
std::string Escaped(const std::string& text)
{
  std::string escaped;
  bool isLineStart = true;
  for (const char letter : text)
  {
    if (isLineStart && (letter == '.' || letter == '\''))
    {
      escaped += "\\&";
    }
    escaped += letter == '\\' ? "\\e" : letter == '-' ? "\\-" : std::string(1, letter);
    isLineStart = letter == '\n';
  }
  return escaped;
}

std::string Bold(const std::string& text) { return "\\fB" + Escaped(text) + "\\fR"; }

std::string Italic(const std::string& text) { return "\\fI" + Escaped(text) + "\\fR"; }

std::vector<const CLI::Option*> Positionals(const CLI::App& command)
{
  return command.get_options([](const CLI::Option* option) { return option->get_positional(); });
}

void WriteSynopsis(const CLI::App& command, std::ostream& page)
{
  page << ".B neuralmesh " << command.get_name() << "\n[" << Italic("options") << "]";
  for (const CLI::Option* option : Positionals(command))
  {
    page << " " << Italic(option->get_name(true))
         << (option->get_items_expected_max() > 1 ? "..." : "");
  }
  page << "\n.br\n";
}

/** What it takes is named as in the help, without what its values are checked for. */
std::string Argument(const CLI::Option& option)
{
  const std::string type = option.get_type_name();
  return option.get_items_expected_max() == 0 ? "" : " " + Italic(type.substr(0, type.find(':')));
}

void WriteOption(const CLI::Option& option, std::ostream& page)
{
  std::vector<std::string> names = DashedNames(option);
  for (std::string& name : names)
  {
    name = Bold(name);
  }
  const std::string defaultValue = option.get_default_str();
  page << ".TP\n"
       << (option.get_positional() ? Italic(option.get_name(true))
                                   : Join(names, ", ") + Argument(option))
       << "\n"
       << Escaped(option.get_description())
       << (defaultValue.empty() ? "" : " (default " + Escaped(defaultValue) + ")") << "\n";
}

void WriteLines(const std::string& lines, std::ostream& page)
{
  page << ".PP\n.EX\n" << Escaped(lines) << "\n.EE\n";
}

/** In place of the table of the help, which is wider than a page. */
void WriteParameters(std::ostream& page)
{
  for (const LearningParameter& parameter : GetLearningParameters())
  {
    const std::string values = parameter.Range + ", default " + parameter.Default;
    page << ".TP\n"
         << Bold(parameter.Name) << "\n"
         << Escaped(parameter.Description + " (" + values + ")") << "\n";
  }
}

void WriteFooter(const std::string& footer, std::ostream& page)
{
  const std::string table = DescribeLearningParameters();
  const std::size_t place = footer.find(table);
  if (place == std::string::npos)
  {
    WriteLines(footer, page);
    return;
  }
  page << ".PP\n" << Escaped(footer.substr(0, place));
  WriteParameters(page);
  WriteLines(CLI::detail::trim_copy(footer.substr(place + table.size())), page);
}

void WriteCommand(const CLI::App& command, std::ostream& page)
{
  page << ".SS neuralmesh " << command.get_name() << "\n"
       << Escaped(command.get_description()) << ".\n";
  for (const CLI::Option* option : Positionals(command))
  {
    WriteOption(*option, page);
  }
  for (const CLI::Option* option : NamedOptions(command))
  {
    WriteOption(*option, page);
  }
  WriteFooter(command.get_footer(), page);
}
}

void WriteManPage(const CLI::App& application, std::ostream& page)
{
  const auto commands = application.get_subcommands(nullptr);
  page << ".TH NEURALMESH 1 \"\" \"NeuralMesh " NEURALMESH_VERSION "\" \"User Commands\"\n"
       << ".SH NAME\nneuralmesh \\- " << Escaped(application.get_description()) << "\n"
       << ".SH SYNOPSIS\n";
  for (const CLI::App* command : commands)
  {
    WriteSynopsis(*command, page);
  }
  page << ".B neuralmesh\n"
       << "[" << Bold("--version") << " | " << Bold("--help") << "]\n"
       << ".SH DESCRIPTION\n"
       << "Turns a raw 3D scan, a point cloud without normals, with noise and outliers, into a\n"
       << "triangle mesh with as many vertices as are asked for, and tells how good meshes are.\n"
       << "The same input and seed give the same bytes.\n"
       << ".SH COMMANDS\n";
  for (const CLI::App* command : commands)
  {
    WriteCommand(*command, page);
  }
  page << ".SH SEE ALSO\n"
       << "The Python package neuralmesh; " << Bold("python3 -m neuralmesh batch --help")
       << " for many scans by one recipe; the pages in " << Italic("share/doc/NeuralMesh") << ".\n";
}
