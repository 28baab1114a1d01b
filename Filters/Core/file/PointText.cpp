// SPDX-License-Identifier: BSD-3-Clause
#include "file/PointText.h"

#include "base/OneLine.h"
#include "cloud/PlyContents.h"
#include "file/InputFile.h"
#include "file/TextColumns.h"
#include "file/TextRow.h"
#include "file/Words.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace neuralmesh
{
namespace
{
/// What other systems write as text is told apart from a line that is wrong.
void requireText(std::string_view line)
{
  if (line.find('\0') != std::string_view::npos)
  {
    throw std::runtime_error("this is UTF-16 or no text; save it as text in UTF-8");
  }
  const std::size_t end = line.find_last_not_of(" \t\r");
  if (end != std::string_view::npos && line.find('\r') < end)
  {
    throw std::runtime_error("its lines end with CR alone; save it with LF or CRLF");
  }
}

bool isComment(std::string_view word) { return word.starts_with('#') || word.starts_with("//"); }

class PointTextReader
{
public:
  explicit PointTextReader(const std::string& path)
    : file_(path)
  {
  }

  FileContents read();

private:
  void readComment();
  void split();
  bool takePoint();
  void requireClear();
  void takeNormal();
  void takeOther();

  InputFile file_;
  FileContents contents_;
  TextRow row_;
  CommaUse commas_ = CommaUse::Separates;
  TextColumns columns_;
  /// What a comment names may be words of a sentence: it counts if there are as many columns.
  std::optional<TextColumns> commented_;
  bool hasNames_ = false, hasDecimalCommas_ = false, hasDecimalPoints_ = false;
  std::size_t lastSize_ = 0;
  double announced_ = 0.;
};

FileContents PointTextReader::read()
{
  while (file_.nextLine())
  {
    std::string_view line = file_.line();
    requireText(line);
    const std::string_view first = takeWord(line);
    if (isComment(first))
    {
      readComment();
      continue;
    }
    if (first.empty())
    {
      continue;
    }
    split();
    if (!takePoint())
    {
      takeOther();
    }
  }
  if (double(contents_.size()) < announced_)
  {
    throw file_.error("damaged: it ends before its last point: " + wholeTextOf(announced_) +
      " are announced, and " + std::to_string(contents_.size()) +
      " are there; if none is missing, correct the number");
  }
  if (hasNames_ && columns_.count == 0 && contents_.size() > 0)
  {
    contents_.remark = "no columns are named x, y and z; the program reads the first three. Name "
                       "the columns of the coordinates x, y and z.";
  }
  return std::move(contents_);
}

void PointTextReader::readComment()
{
  std::string_view line = file_.line();
  if (line.starts_with("# ") && !contents_.shift)
  {
    contents_.shift = shiftOfComment(line.substr(2));
  }
  if (contents_.size() == 0)
  {
    line.remove_prefix(std::min(line.find_first_not_of(" \t#/"), line.size()));
    const auto columns = columnsOfNames(line);
    commented_ = columns ? columns : commented_;
  }
}

void PointTextReader::split()
{
  const std::string_view line = file_.line();
  if (contents_.size() == 0 && columns_.count == 0 && commented_)
  {
    row_.splitAt(line, commented_->separator);
    columns_ = row_.size() == commented_->count ? *commented_ : columns_;
  }
  const std::size_t last = *std::max_element(columns_.position.begin(), columns_.position.end());
  commas_ = columns_.separator == ',' ? CommaUse::Separates : commaUse(line, last + 1);
  row_.splitAt(line, columns_.separator, commas_ == CommaUse::IsDecimal);
}

bool PointTextReader::takePoint()
{
  Eigen::Vector3d point;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (!row_.number(columns_.position[axis], point[Eigen::Index(axis)]))
    {
      return false;
    }
  }
  requireClear();
  contents_.addPoint(point);
  takeNormal();
  lastSize_ = row_.size();
  return true;
}

/// That what was read can have been meant in no other way.
void PointTextReader::requireClear()
{
  if (file_.isLastWithoutEnd() && row_.size() < lastSize_)
  {
    throw file_.errorInLine("the file ends in the middle of it");
  }
  if (columns_.count > 0 && row_.filledSize() > columns_.count)
  {
    throw file_.errorInLine(std::to_string(row_.filledSize()) + " values, but " +
      std::to_string(columns_.count) + " names of columns: " + oneLine(file_.line()));
  }
  for (const std::size_t column : columns_.position)
  {
    const bool hasComma = row_[column].find(',') != std::string_view::npos;
    hasDecimalCommas_ = hasDecimalCommas_ || hasComma;
    hasDecimalPoints_ = hasDecimalPoints_ || row_[column].find('.') != std::string_view::npos;
  }
  if (commas_ == CommaUse::IsUnclear || hasTornNumbers(file_.line()) ||
    (hasDecimalCommas_ && hasDecimalPoints_))
  {
    throw file_.errorInLine("its commas may be in numbers or between them; write numbers with a "
                            "decimal point and without commas: " +
      oneLine(file_.line()));
  }
}

void PointTextReader::takeNormal()
{
  if (!columns_.normal)
  {
    return;
  }
  Eigen::Vector3d normal;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (!row_.number((*columns_.normal)[axis], normal[Eigen::Index(axis)]))
    {
      normal.setZero(); // which tells nothing
      break;
    }
  }
  contents_.normals.emplace_back(normal.cast<float>());
}

/// Names of columns, a title, or the number of points; throws what is wrong with any other line.
void PointTextReader::takeOther()
{
  double number = 0.;
  const bool isNumber = row_.number(0, number);
  if (contents_.size() == 0 && isNumber && row_.size() == 1)
  {
    announced_ = number;
    return;
  }
  bool hasNumber = isNumber;
  for (std::size_t i = 0; columns_.count > 0 && i < row_.size(); ++i)
  {
    hasNumber = hasNumber || row_.number(i, number);
  }
  if (contents_.size() > 0 || hasNumber)
  {
    throw file_.errorInLine("this is not a point: " + oneLine(file_.line()));
  }
  const auto columns = columnsOfNames(file_.line());
  columns_ = columns ? *columns : columns_;
  // A shorter line is a title or a unit.
  hasNames_ = hasNames_ || row_.size() >= 3;
}
}

FileContents readPointText(const std::string& path) { return PointTextReader(path).read(); }

std::string pointTextOf(const FileContents& contents, std::size_t point)
{
  const auto text = [i = 3 * point](const auto& numbers)
  { return textOf(numbers[i]) + " " + textOf(numbers[i + 1]) + " " + textOf(numbers[i + 2]); };
  return contents.floats.empty() ? text(contents.doubles) : text(contents.floats);
}

std::string pointTextOf(const FileContents& contents)
{
  std::string text;
  if (contents.shift)
  {
    text = "# " + commentOfShift(*contents.shift) + "\n";
  }
  for (std::size_t i = 0; i < contents.size(); ++i)
  {
    text += pointTextOf(contents, i);
    for (Eigen::Index axis = 0; axis < 3 && !contents.normals.empty(); ++axis)
    {
      text += ' ';
      text += textOf(contents.normals[i][axis]);
    }
    text += '\n';
  }
  return text;
}
}
