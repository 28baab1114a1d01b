// SPDX-License-Identifier: BSD-3-Clause
#include "run/Checkpoint.h"

#include "base/Archive.h"
#include "base/AtomicFile.h"
#include "learn/ParameterTable.h"
#include "run/Tuning.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace neuralmesh
{
namespace
{
/// The first bytes of the file: its kind, and the byte order of the machine.
constexpr std::uint64_t Kind = 0x4e6575724d736843u;
/// Which values there are, and in which order: another number is another version of the program.
constexpr std::uint64_t Format = 7;
using Sum = std::uint64_t;

/// Of the names and sizes of the parameters in the file: with others it is another version, too.
Sum checksumOfTable()
{
  std::string table;
  forEachParameter(
    [&](const auto& parameter)
    {
      if (parameter.changesResult)
      {
        const auto size = sizeof(Parameters().*parameter.place);
        table += std::string(parameter.name) + " " + std::to_string(size) + "\n";
      }
    });
  Checksum checksum;
  checksum.add(std::as_bytes(std::span(table)));
  return checksum.value();
}

std::runtime_error noCheckpoint() { return std::runtime_error("it is no checkpoint"); }

template <typename T>
Sum checksumOf(std::span<const T> values)
{
  Checksum checksum;
  checksum.add(std::as_bytes(values));
  return checksum.value();
}

Sum checksumOf(Learner& learner)
{
  Archive archive;
  learner.exchange(archive);
  archive.finish();
  return archive.checksum();
}

/// How the cloud lies in the input, and what the learner takes from it apart from the points.
Sum checksumOfPlace(const PointCloud& cloud)
{
  const Eigen::Vector3d center = cloud.toInput(Vector4());
  const Eigen::Vector3d low = cloud.bulkMin().toDouble(), high = cloud.bulkMax().toDouble();
  const std::array<double, 11> numbers{ center.x(), center.y(), center.z(), cloud.unit(),
    cloud.diagonal(), low.x(), low.y(), low.z(), high.x(), high.y(), high.z() };
  return checksumOf(std::span<const double>(numbers));
}

/// Fills from a file; `size` bytes of it must be there.
Archive::Source sourceOf(std::ifstream& file)
{
  return [&file](std::span<std::byte> bytes)
  {
    file.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(bytes.size()));
    if (!file)
    {
      throw std::runtime_error("it cannot be read");
    }
  };
}

/// The checksum of the contents, which come before it, must be right.
void requireWhole(std::ifstream& file, std::uint64_t size)
{
  const Archive::Source read = sourceOf(file);
  constexpr std::size_t AtOnce = std::size_t(1) << 16;
  std::vector<std::byte> bytes(AtOnce);
  Checksum checksum;
  for (std::uint64_t left = size; left > 0;)
  {
    const auto part = std::span(bytes).first(std::size_t(std::min<std::uint64_t>(left, AtOnce)));
    read(part);
    checksum.add(part);
    left -= part.size();
  }
  Sum wanted = 0;
  read(std::as_writable_bytes(std::span(&wanted, 1)));
  if (checksum.value() != wanted)
  {
    throw Archive::Error();
  }
}

bool isTuned(std::string_view parameter)
{
  return std::find(TunedParameters.begin(), TunedParameters.end(), parameter) !=
    TunedParameters.end();
}

template <typename T>
std::string inWords(const char* name, T there, T here)
{
  std::ostringstream text;
  text.precision(10);
  text << name << " (" << double(there) << " there, " << double(here) << " here)";
  return text.str();
}
}

void LearningState::exchange(Archive& archive)
{
  archive(learner, rules, curve, reason);
  archive.require(
    reason >= StopReason::None && reason <= StopReason::Stalled && reason != StopReason::TimeLimit);
}

Checkpoint::Checkpoint(CheckpointPlan plan, const PointCloud& cloud, const Parameters& parameters)
  : plan_(std::move(plan))
  , parameters_(parameters)
{
  if (!isOn())
  {
    return;
  }
  requireWritablePlace(plan_.path);
  input_ = { { "the points", checksumOf(cloud.points()) },
    { "the weights", checksumOf(cloud.weights()) },
    { "the place of the points", checksumOfPlace(cloud) } };
  isThere_ = std::filesystem::exists(plan_.path);
  if (isThere_)
  {
    read([this](Archive& archive) { goesOn_ = exchangeRun(archive, false); });
  }
}

std::uint64_t Checkpoint::resume(LearningState& state, bool isStartWhole)
{
  if (!isOn())
  {
    return 0;
  }
  start_ = checksumOf(state.learner);
  if (goesOn_)
  {
    read(
      [&](Archive& archive)
      {
        exchangeRun(archive, true);
        Sum start = start_;
        archive(start);
        if (isStartWhole && plan_.isStartWhole && start != start_)
        {
          throw std::runtime_error("it is that of another run: learning starts from another mesh");
        }
        start_ = start;
        archive(state);
        archive.finish();
      });
    savedIterations_ = state.learner.counts().iterations;
  }
  saveTime_ = Clock::now();
  return savedIterations_;
}

void Checkpoint::saveIfDue(LearningState& state)
{
  const bool hasEnded = state.reason != StopReason::None;
  const bool isNew = state.learner.counts().iterations != savedIterations_;
  const std::chrono::duration<double> interval(plan_.interval);
  if (isOn() &&
    ((hasEnded && !isThere_) || (isNew && (hasEnded || Clock::now() >= saveTime_ + interval))))
  {
    write(state);
    isThere_ = true;
    savedIterations_ = state.learner.counts().iterations;
    saveTime_ = Clock::now();
  }
}

void Checkpoint::write(LearningState& state)
{
  LearningState written = state;
  if (written.reason == StopReason::Cancelled || written.reason == StopReason::TimeLimit)
  {
    written.reason = StopReason::None; // learning may go on
  }
  try
  {
    writeAtomicFile(plan_.path,
      [&](const std::string& temporary)
      {
        std::ofstream file(temporary, std::ios::binary);
        const Archive::Sink write = [&file](std::span<const std::byte> bytes)
        { file.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size())); };
        Archive archive(write);
        if (exchangeRun(archive, state.learner.counts().iterations > 0))
        {
          archive(start_, written);
        }
        archive.finish();
        const Sum checksum = archive.checksum();
        write(std::as_bytes(std::span(&checksum, 1)));
        file.close();
        if (!file)
        {
          throw std::runtime_error("not all of it could be written; is the disk full?");
        }
      });
  }
  catch (const std::runtime_error& error)
  {
    if (!std::exchange(hasWarned_, true))
    {
      plan_.warn(error.what());
    }
  }
}

/// Calls `use` with what is in the file, once that is known to be whole.
void Checkpoint::read(const std::function<void(Archive&)>& use) const
{
  try
  {
    if (!std::filesystem::is_regular_file(plan_.path))
    {
      throw noCheckpoint();
    }
    const std::uint64_t size = std::filesystem::file_size(plan_.path);
    if (size < sizeof(Kind) + sizeof(Sum))
    {
      throw noCheckpoint();
    }
    std::ifstream file(plan_.path, std::ios::binary);
    auto kind = Kind;
    sourceOf(file)(std::as_writable_bytes(std::span(&kind, 1)));
    if (kind != Kind)
    {
      throw noCheckpoint();
    }
    file.seekg(0);
    requireWhole(file, size - sizeof(Sum));
    file.seekg(0);
    Archive archive(sourceOf(file), size - sizeof(Sum));
    use(archive);
  }
  catch (const std::exception& error)
  {
    throw std::runtime_error("the run cannot go on from " + plan_.path + ": " + error.what());
  }
}

/// Whether anything is learnt, and of which run this is the checkpoint then. Throws std::runtime_error
/// if what is read is another one.
bool Checkpoint::exchangeRun(Archive& archive, bool isLearnt) const
{
  const Sum ownTable = checksumOfTable();
  auto kind = Kind, format = Format, table = ownTable;
  std::string version = NEURALMESH_VERSION;
  archive(kind, format);
  if (format == Format)
  {
    archive(version, table);
  }
  if (format != Format || version != NEURALMESH_VERSION || table != ownTable)
  {
    throw std::runtime_error("it is that of another version of NeuralMesh");
  }
  archive(isLearnt);
  if (!isLearnt)
  {
    return false;
  }
  std::string differences;
  const auto addDifference = [&](const std::string& text)
  { differences += (differences.empty() ? "" : ", ") + text; };
  for (const auto& [name, checksum] : input_)
  {
    Sum there = checksum;
    archive(there);
    if (there != checksum)
    {
      addDifference(name);
    }
  }
  forEachParameter(
    [&](const auto& parameter)
    {
      if (!parameter.changesResult)
      {
        return;
      }
      const auto here = parameters_.*parameter.place;
      auto there = here;
      archive(there);
      const bool isCompared = plan_.areParametersChosen || !isTuned(parameter.name);
      if (isCompared && there != here)
      {
        addDifference(inWords(parameter.name, there, here));
      }
    });
  if (!differences.empty())
  {
    throw std::runtime_error("it is that of another run, from which these differ: " + differences);
  }
  return true;
}
}
