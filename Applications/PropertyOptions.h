// SPDX-License-Identifier: BSD-3-Clause
#ifndef PropertyOptions_h
#define PropertyOptions_h

#include <CLI/CLI.hpp>

#include <limits>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

/** Numbers that an option takes, and that which holds without it: those of a property. */
template <typename ValueT>
struct PropertyNumbers
{
  ValueT Default;
  ValueT Minimum;
  ValueT Maximum;
};
template <typename ValueT>
PropertyNumbers(ValueT, ValueT, ValueT) -> PropertyNumbers<ValueT>;

#define NEURAL_MESH_NUMBERS(filter, property)                                                      \
  PropertyNumbers                                                                                  \
  {                                                                                                \
    (filter)->Get##property(), (filter)->Get##property##MinValue(),                                \
      (filter)->Get##property##MaxValue()                                                          \
  }

/** A number in full where that is short. */
template <typename ValueT>
std::string PlainNumber(ValueT value)
{
  constexpr int Digits = 10;
  std::ostringstream text;
  text.precision(Digits);
  text << value;
  return text.str();
}

/** "4 to 100", or "from 4 on" if it ends with the type. */
template <typename ValueT>
std::string RangeText(ValueT minimum, ValueT maximum)
{
  if (std::is_integral_v<ValueT> && maximum == std::numeric_limits<ValueT>::max())
  {
    return "from " + PlainNumber(minimum) + " on";
  }
  return PlainNumber(minimum) + " to " + PlainNumber(maximum);
}

/** What tells the range of an option and what holds without it, for its description. */
template <typename ValueT>
std::string Described(const PropertyNumbers<ValueT>& numbers)
{
  return RangeText(numbers.Minimum, numbers.Maximum) + " (default " + PlainNumber(numbers.Default) +
    ")";
}

/** Refuses what is no number within both ends; NaN, too, which no end holds back. */
template <typename ValueT>
CLI::Validator NumberWithin(ValueT minimum, ValueT maximum)
{
  return CLI::Validator(
    [minimum, maximum](std::string& text) -> std::string
    {
      ValueT value{};
      if (CLI::detail::lexical_cast(text, value) && value >= minimum && value <= maximum)
      {
        return {};
      }
      return text + " is no " + (std::is_integral_v<ValueT> ? "integer " : "number ") + "from " +
        PlainNumber(minimum) + " to " + PlainNumber(maximum);
    },
    "");
}

/** An option that sets a number. */
template <typename ValueT>
CLI::Option* AddNumber(CLI::App* command, const std::string& name, ValueT& value, ValueT minimum,
  ValueT maximum, const std::string& description, const std::string& type)
{
  return command->add_option(name, value, description)
    ->check(NumberWithin(minimum, maximum))
    ->type_name(type);
}

/** One that sets a property. */
template <typename ValueT>
CLI::Option* AddNumber(CLI::App* command, const std::string& name, ValueT& value,
  const PropertyNumbers<ValueT>& numbers, const std::string& description, const std::string& type)
{
  value = numbers.Default;
  return AddNumber(command, name, value, numbers.Minimum, numbers.Maximum, description, type);
}

/** A word for a value of a property. */
struct PropertyWord
{
  std::string Word;
  int Value;
  std::string Text; ///< what it stands for; empty: the word says it
};

/** The words with bars between them. */
std::string Joined(const std::vector<PropertyWord>& words);

/** The value of a word; throws UsageError for any other. */
int ValueOf(
  const std::string& option, const std::string& word, const std::vector<PropertyWord>& words);

/** The word of a value. */
const std::string& WordOf(const std::vector<PropertyWord>& words, int value);

/** "one (default): what it is; two: what that is". */
std::string Described(const std::vector<PropertyWord>& words, int defaultValue);

/** An option that takes words for the values of a property. */
CLI::Option* AddChoice(CLI::App* command, const std::string& name, int& value,
  const std::vector<PropertyWord>& words, const std::string& description);

#endif
