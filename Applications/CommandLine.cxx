// SPDX-License-Identifier: BSD-3-Clause
#include "CommandLine.h"

#include "CompareCommand.h"
#include "ExplainCommand.h"
#include "InfoCommand.h"
#include "ReconstructCommand.h"
#include "TuneCommand.h"
#include "UsageMessage.h"

CommandLine::CommandLine()
  : Application("Triangle meshes from point clouds, by learning", "neuralmesh")
{
  this->Application.set_version_flag("--version", NEURALMESH_VERSION);
  this->Application.require_subcommand(1);
  this->Application.failure_message(UsageMessage);
  for (const auto& add :
    { AddReconstructCommand, AddTuneCommand, AddCompareCommand, AddExplainCommand, AddInfoCommand })
  {
    // The newest subcommand is the last one.
    const auto run = add(this->Application);
    this->Commands[this->Application.get_subcommands({}).back()] = run;
  }
}
