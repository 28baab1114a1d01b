# SPDX-License-Identifier: BSD-3-Clause
"""The list of parameters, Filters/Parameters.json: read, and held against what it must be.

A choice has
  name        of the type; the core has an enum class of it
  title       what is chosen, in a few words
  values      each with its name and its text, from 0 on
  constants   what stands behind the names of the values in the header of VTK (none)
  owner       the class of VTK whose enumeration it is; the core does not know it then (none)
  engine      false if the core does not know it either (true)

A group, which is a table of Documentation/Guide/Parameters.md, has
  key         by which templates name it
  title       of the section in the struct
  panel       the label of the group of the panel of ParaView in which its parameters stand; null for
              none. Templates of panels say which groups stand together: those of one label
  parameters

Text is written into comments, tables and XML: it has no control characters, no */, and where it goes into a
table no |.

A parameter has, with what holds without a key in brackets,
  name        of the property
  type        bool, int, count, double, or the name of a choice
  default     the value; of a double "1/3", too, of a choice the name
  thesis      what the preset of the thesis sets (the default)
  thesis_text what to say of that in its place
  range       both ends; null where the type ends; not for bool and choices
  zero        whether 0 is a value, too, and below the range (false); not for bool and choices
  class       of VTK, which has the property (vtkNeuralMeshAlgorithm)
  engine      false if the core does not know it; or its type there
  preset      false if presets leave it alone (true in vtkNeuralMeshAlgorithm, else false)
  result      false if no result depends on it (true)
  command     the option of the command line that sets it in place of --set; "" for none
  fuzz        the range that random runs take in its place, each of them
  panel       "shown" if the panel shows it at first ("advanced")
  symbol      in the thesis, with the equation or the chapter
  unit        of the value
  variants    those that use it (all)
  when        conditions under which it counts: "Order is List", "EdgeFlips is on", "FitRounds is not 0"
  short       a few words: for the struct, the help of the command, the table
  text        sentences for the header and the panel
  details     more of them, for the header alone; a list has a line for each paragraph
  why         what the table says of the default
"""

import dataclasses
import fractions
import json
import math
import re
import unicodedata

import reserved

CHOICE_KEYS = {"name": str, "title": str, "values": list, "constants": str, "owner": str, "engine": bool}
VALUE_KEYS = {"name": str, "text": str}
GROUP_KEYS = {"key": str, "title": str, "panel": (str, type(None)), "parameters": list}
PARAMETER_KEYS = {
    "name": str, "type": str, "default": (bool, int, float, str), "thesis": (bool, int, float, str),
    "thesis_text": str, "range": list, "zero": bool,
    "class": str, "engine": (bool, str), "preset": bool,
    "result": bool, "command": str, "fuzz": list, "panel": str, "symbol": str, "unit": str,
    "variants": list, "when": list, "short": str, "text": str, "details": (str, list), "why": str,
}
NEEDED = {
    "choice": ("name", "title", "values"),
    "value": ("name", "text"),
    "group": ("key", "title", "panel", "parameters"),
    "parameter": ("name", "type", "default", "short", "text"),
}
CLASSES = ("vtkNeuralMeshAlgorithm", "vtkNeuralMesh", "vtkNeuralMeshEnsemble")
# What the core may have in place of an int or a count, and where it ends.
ENGINE_TYPES = {"std::uint64_t": 2**64 - 1, "std::size_t": 2**64 - 1, "unsigned": 2**32 - 1}
# Where a type ends, for a range that does not say.
ENDS = {"int": (-(2**31), 2**31 - 1), "count": (0, 2**63 - 1), "double": (None, None)}
# What is longer makes the table of the command too wide.
LONGEST_SHORT = 75
# Those that stand in a table of Markdown.
IN_TABLES = ("short", "symbol", "unit", "why", "thesis_text")
# Those that Doxygen reads.
IN_COMMENTS = ("title", "symbol", "thesis_text", "short", "text", "details")


class ListError(Exception):
    """What is wrong with the list: a line each."""


def spaced(name):
    """RemovalLimit as Removal Limit."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", " ", name)


def finite(value):
    """A number, or a fraction like "1/3", as a double; nothing if it is none or too large."""
    try:
        number = float(fractions.Fraction(value) if isinstance(value, str) else value)
    except OverflowError:
        return None
    return number if math.isfinite(number) else None


def texts(entry):
    """All texts in an entry, with their keys."""
    for key, value in entry.items():
        for text in value if isinstance(value, list) else [value]:
            if isinstance(text, str):
                yield key, text


def snake_case(name):
    """RemovalLimit as removal_limit."""
    return spaced(name).replace(" ", "_").lower()


def first_small(name):
    """RemovalLimit as removalLimit."""
    return name[0].lower() + name[1:]


@dataclasses.dataclass
class Value:
    """One that can be chosen."""

    name: str
    text: str
    constant: str  # in the header of VTK


@dataclasses.dataclass
class Choice:
    """Some values to choose from."""

    name: str
    title: str
    owner: str
    values: list
    in_engine: bool = True

    def index(self, name):
        return [value.name for value in self.values].index(name)


@dataclasses.dataclass
class Parameter:
    """An entry of the list."""

    name: str
    type: str
    choice: Choice
    default: object
    thesis: object
    low: object
    high: object
    keys: dict

    def __getattr__(self, key):
        """What the list says, or nothing."""
        return self.__dict__["keys"].get(key)

    @property
    def owner(self):
        return self.keys.get("class", CLASSES[0])

    @property
    def in_preset(self):
        return self.keys.get("preset", self.owner == CLASSES[0])

    @property
    def in_engine(self):
        return self.engine is not False

    @property
    def field(self):
        """The name in the core."""
        return first_small(self.name)

    @property
    def is_open(self):
        """Whether the range ends where the type does."""
        return self.type in ENDS and self.high == ENDS[self.type][1]

    def number(self, value):
        """The value as a number."""
        if self.choice:
            return self.choice.index(value)
        return float(fractions.Fraction(value)) if isinstance(value, str) else value


@dataclasses.dataclass
class Group:
    """Parameters that belong together."""

    key: str
    title: str
    panel: str
    parameters: list
    places: set = dataclasses.field(default_factory=set)  # of templates that name it


class ParameterList:
    """All that the list says. What a template names and is not there is a ListError."""

    def __init__(self, path, choices, groups):
        self.path = path
        self.choices = choices
        self.groups = groups
        self.parameters = [parameter for group in groups for parameter in group.parameters]

    def named(self, kind, entries, name, key="name"):
        for entry in entries:
            if getattr(entry, key) == name:
                return entry
        raise self.error(f"there is no {kind} {name!r}, which a template names")

    def error(self, message):
        return ListError(f"{self.path}: {message}")

    def group(self, key, place):
        group = self.named("group", self.groups, key, "key")
        group.places.add(place)
        return group

    def parameter(self, name):
        return self.named("parameter", self.parameters, name)

    def choice(self, name):
        return self.named("choice", self.choices, name)

    def require_places(self):
        """Raises if something of the list would not come out, once all templates are filled."""
        for group in self.groups:
            wanted = {"table": "a table of the documentation", "properties": "the panel"}
            if group.panel is not None:
                wanted["panel"] = "a group of the panel"
            for place, words in wanted.items():
                if place not in group.places:
                    raise self.error(f"{group.key}: no template has the group in {words}")


class Reader:
    """Reads the list, and notes what is wrong with it."""

    def __init__(self):
        self.errors = []

    def raise_errors(self, path):
        if self.errors:
            raise ListError("\n".join(f"{path}: {error}" for error in self.errors))

    def check(self, condition, place, message):
        if not condition:
            self.errors.append(f"{place}: {message}")
        return condition

    def keys(self, entry, kind, known, place):
        """Whether an entry has the keys that it needs, and no others, of the right types."""
        if not self.check(isinstance(entry, dict), place, f"a {kind} must be an object"):
            return False
        count = len(self.errors)
        for key, value in entry.items():
            if self.check(key in known, place, f"there is no key {key!r}"):
                wanted = known[key]
                # In Python, True is an integer.
                is_right = isinstance(value, wanted) and (
                    not isinstance(value, bool) or bool in (wanted if isinstance(wanted, tuple) else (wanted,))
                )
                self.check(is_right, place, f"{key} cannot be {value!r}")
        for key in NEEDED[kind]:
            self.check(key in entry and entry[key] != "", place, f"{key} is missing")
        self.texts(entry, place)
        return len(self.errors) == count

    def texts(self, entry, place):
        """Notes texts that would break what they are written into."""
        for key, text in texts(entry):
            # Control characters, halves of pairs, and what ends a line.
            is_plain = all(unicodedata.category(letter) not in ("Cc", "Cs", "Zl", "Zp") for letter in text)
            self.check(is_plain, place, f"{key} has a control character or a new line")
            self.check("*/" not in text, place, f"*/ in {key} ends a comment")
            if key in IN_TABLES:
                self.check("|" not in text, place, f"{key} has a |, which ends a cell of a table")
            if key in IN_COMMENTS:
                self.check(not re.search(r"[@\\]", text), place, f"{key} has a @ or \\, as commands of Doxygen")

    def names(self, entries, place):
        """Whether names are those of types in C++, each once."""
        seen = set()
        for entry in entries:
            self.check(re.fullmatch("[A-Z][A-Za-z0-9]+", entry), place, f"{entry!r} is no name")
            self.check(entry not in seen, place, f"{entry} is there twice")
            seen.add(entry)

    def free(self, name, place):
        """Notes a name of a parameter that C++ or VTK has already."""
        field = first_small(name)
        self.check(field not in reserved.CPP, place, f"the core cannot call it {field}, a word of C++")
        self.check(name not in reserved.VTK, place, f"VTK has Set{name}() or Get{name}() already")

    def choices(self, entries):
        choices = []
        for entry in entries:
            place = entry.get("name", "a choice") if isinstance(entry, dict) else "a choice"
            if not self.keys(entry, "choice", CHOICE_KEYS, place):
                continue
            if not all([self.keys(value, "value", VALUE_KEYS, place) for value in entry["values"]]):
                continue
            self.names([value["name"] for value in entry["values"]], place)
            self.check(len(entry["values"]) > 1, place, "there is nothing to choose")
            suffix = entry.get("constants", "")
            values = [
                Value(value["name"], value["text"], snake_case(value["name"]).upper() + suffix)
                for value in entry["values"]
            ]
            in_engine = entry.get("engine", "owner" not in entry)
            choices.append(Choice(entry["name"], entry["title"], entry.get("owner"), values, in_engine))
        self.names([choice.name for choice in choices], "choices")
        constants = [value.constant for choice in choices for value in choice.values]
        for constant in reserved.MACROS.intersection(constants):
            self.check(False, "choices", f"C++ has a macro {constant} already")
        for constant in {constant for constant in constants if constants.count(constant) > 1}:
            self.check(False, "choices", f"{constant} is the constant of two values")
        return choices

    def value(self, entry, key, choice, ends, place):
        """Notes if a value is none of the type, or outside of the range."""
        value, kind = entry[key], entry["type"]
        if choice:
            names = [value.name for value in choice.values]
            self.check(value in names, place, f"{key} {value!r} is none of {', '.join(names)}")
            return
        number = value
        if kind == "double" and isinstance(value, str) and re.fullmatch(r"\d+/[1-9]\d*", value):
            number = finite(value)
            if not self.check(number is not None, place, f"{key} is beyond the type double"):
                return
        wanted = {"bool": bool, "double": (int, float)}.get(kind, int)
        is_right = isinstance(number, wanted) and isinstance(number, bool) == (kind == "bool")
        if self.check(is_right, place, f"{key} {value!r} is no {kind}") and ends:
            is_within = (ends[0] is None or number >= ends[0]) and (ends[1] is None or number <= ends[1])
            self.check(is_within, place, f"{key} {value!r} is outside the range {ends[0]} to {ends[1]}")

    def ends(self, entry, key, place):
        """Both ends of a range, or nothing if it is none."""
        pair = entry[key]
        is_pair = len(pair) == 2 and all(
            end is None or (isinstance(end, (int, float)) and not isinstance(end, bool)) for end in pair
        )
        if not self.check(is_pair, place, f"{key} must have two ends"):
            return None
        kind = entry["type"]
        ends = tuple(ENDS[kind][i] if end is None else end for i, end in enumerate(pair))
        if not self.check(None not in ends, place, f"{key} of a double must have two numbers"):
            return None
        are_finite = None not in [finite(end) for end in ends]
        if not self.check(are_finite, place, f"{key} is beyond any type"):
            return None
        is_whole = kind == "double" or all(isinstance(end, int) for end in ends)
        self.check(is_whole, place, f"{key} of an {kind} must have whole ends")
        low, high = ENDS[kind]
        is_within = (low is None or ends[0] >= low) and (high is None or ends[1] <= high)
        self.check(is_within, place, f"{key} {pair} is beyond the type {kind}")
        is_right = is_whole and self.check(ends[0] < ends[1], place, f"{key} {pair} is empty")
        return ends if is_right else None

    def parameter(self, entry, choices):
        place = entry.get("name", "a parameter") if isinstance(entry, dict) else "a parameter"
        if not self.keys(entry, "parameter", PARAMETER_KEYS, place):
            return None
        choice = next((choice for choice in choices if choice.name == entry["type"]), None)
        is_type = choice or entry["type"] in ("bool", *ENDS)
        if not self.check(is_type, place, f"there is no type {entry['type']}"):
            return None
        self.free(entry["name"], place)
        ends = None
        if choice or entry["type"] == "bool":
            for key in ("range", "fuzz"):
                self.check(key not in entry, place, f"a {entry['type']} has no {key}")
            self.check("zero" not in entry, place, f"a {entry['type']} has no zero")
            ends = (0, len(choice.values) - 1) if choice else (0, 1)
        elif self.check("range" in entry, place, "range is missing"):
            ends = self.ends(entry, "range", place)
            fuzz = self.ends(entry, "fuzz", place) if "fuzz" in entry else None
            is_above = not (ends and entry.get("zero")) or ends[0] > 0
            self.check(is_above, place, "0 is not below the range")
            is_within = not (ends and fuzz) or (ends[0] <= fuzz[0] and fuzz[1] <= ends[1])
            self.check(is_within, place, f"fuzz {entry.get('fuzz')} is outside the range")
        is_number = not choice and entry["type"] != "bool"
        for key in ("default", "thesis"):
            if key in entry:
                self.value(entry, key, choice, ends if is_number else None, place)
        self.check(entry.get("class", CLASSES[0]) in CLASSES, place, "class is none that has parameters")
        self.engine(entry, choice, ends, place)
        self.check(entry.get("panel", "shown") == "shown", place, "panel can only be 'shown'")
        self.check(len(entry["short"]) <= LONGEST_SHORT, place, f"short has more than {LONGEST_SHORT} letters")
        self.check(entry["text"].endswith("."), place, "text must end with a full stop")
        self.check(re.match("[A-Za-z0-9]", entry["text"]), place, "text must begin with a word")
        self.check('"' not in entry["short"], place, 'short has a ", which ends text of C++')
        details = entry.get("details", "")
        paragraphs = details if isinstance(details, list) else [details]
        is_text = all(isinstance(paragraph, str) for paragraph in paragraphs)
        self.check(is_text, place, "details must be text, or a list of it")
        for key in ("variants", "when"):
            names = entry.get(key, ["none"])
            are_names = names and all(isinstance(name, str) for name in names)
            if self.check(are_names, place, f"{key} must be a list of texts, of one at least"):
                self.check(len(set(names)) == len(names), place, f"{key} has something twice")
            else:
                del entry[key]
        low, high = ends or (None, None)
        parameter = Parameter(
            entry["name"], entry["type"], choice, entry["default"],
            entry.get("thesis", entry["default"]), low, high, entry,
        )
        is_preset_right = not parameter.in_preset or parameter.owner == CLASSES[0]
        self.check(is_preset_right, place, f"a preset sets nothing of {parameter.owner}")
        self.check(parameter.in_engine or not parameter.in_preset, place, "the engine must know what a preset sets")
        is_engine_right = parameter.in_engine or parameter.owner != CLASSES[2]
        self.check(is_engine_right, place, f"the engine must know what {parameter.owner} has")
        if "thesis" in entry or "thesis_text" in entry:
            self.check(parameter.in_preset, place, "no preset sets it: it has no value of the thesis")
        return parameter

    def engine(self, entry, choice, ends, place):
        """Notes a type of the core that does not hold the values."""
        engine = entry.get("engine", False)
        if not self.check(engine is False or engine in ENGINE_TYPES, place, "engine is no type"):
            return
        if engine:
            is_whole = self.check(entry["type"] in ("int", "count"), place, f"a {entry['type']} has no engine type")
            holds = not (is_whole and ends) or (ends[0] >= 0 and ends[1] <= ENGINE_TYPES[engine])
            self.check(holds, place, f"{engine} does not hold the range")
        elif "engine" not in entry and choice:
            self.check(choice.in_engine, place, f"the engine does not know the choice {choice.name}")

    def conditions(self, found):
        """Notes variants and conditions that name nothing."""
        variants = next((choice for choice in found.choices if choice.name == "Variant"), None)
        known = {value.name for value in variants.values} if variants else set()
        by_name = {parameter.name: parameter for parameter in found.parameters}
        for parameter in found.parameters:
            for variant in parameter.variants or ():
                self.check(variant in known, parameter.name, f"there is no variant {variant!r}")
            for condition in parameter.when or ():
                match = re.fullmatch(r"(\w+) is (not )?(\w+)", condition)
                other = by_name.get(match[1]) if match else None
                if not self.check(other, parameter.name, f"the condition {condition!r} names no parameter"):
                    continue
                self.check(other is not parameter, parameter.name, f"{condition!r} is a condition of itself")
                has_both = CLASSES.index(other.owner) <= CLASSES.index(parameter.owner)
                self.check(has_both, parameter.name, f"{parameter.owner} has no {other.name}, as {condition!r} needs")
                if other.choice or other.type == "bool":
                    values = [value.name for value in other.choice.values] if other.choice else ["on", "off"]
                    is_value = match[3] in values
                else:
                    is_number = re.fullmatch("[0-9]{1,20}", match[3])
                    is_value = is_number and other.low <= int(match[3]) <= other.high
                self.check(is_value, parameter.name, f"{match[3]} in {condition!r} is no value of {match[1]}")


def keys_once(pairs):
    """An object of JSON, each key of which is there once."""
    keys = [key for key, _ in pairs]
    for key in keys:
        if keys.count(key) > 1:
            raise ValueError(f"the key {key!r} is there twice")
    return dict(pairs)


def no_number(word):
    raise ValueError(f"{word} is no number")


def read(path):
    """The list in a file. Raises ListError."""
    reader = Reader()
    try:
        text = path.read_text(encoding="utf-8")
        content = json.loads(text, object_pairs_hook=keys_once, parse_constant=no_number)
    except (OSError, ValueError, RecursionError) as error:
        raise ListError(f"{path}: {error}") from error
    is_right = isinstance(content, dict) and set(content) == {"choices", "groups"}
    if not is_right or not all(isinstance(part, list) for part in content.values()):
        raise ListError(f"{path}: there must be lists of choices and groups, and nothing else")
    choices = reader.choices(content["choices"])
    # Without all choices the entries that have them would seem wrong, too.
    reader.raise_errors(path)
    groups = []
    for entry in content["groups"]:
        place = entry.get("key", "a group") if isinstance(entry, dict) else "a group"
        if reader.keys(entry, "group", GROUP_KEYS, place):
            parameters = [reader.parameter(parameter, choices) for parameter in entry["parameters"]]
            known = [parameter for parameter in parameters if parameter]
            reader.check(re.fullmatch("[a-z]+", entry["key"]), place, "the key must be a word in small letters")
            reader.check(parameters, place, "there are no parameters in it")
            groups.append(Group(entry["key"], entry["title"], entry["panel"], known))
    found = ParameterList(path, choices, groups)
    keys = [group.key for group in groups]
    reader.check(len(set(keys)) == len(keys), "groups", "a key is there twice")
    reader.names([parameter.name for parameter in found.parameters], "parameters")
    # Likewise conditions that name them.
    reader.raise_errors(path)
    reader.conditions(found)
    reader.raise_errors(path)
    return found
