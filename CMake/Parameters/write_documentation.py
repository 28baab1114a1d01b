# SPDX-License-Identifier: BSD-3-Clause
"""The tables of Documentation/Guide/Parameters.md."""

import fractions
import re

from text import shown

GREEK = {"alpha": "α", "delta": "δ", "lambda": "λ"}


def symbol(parameter):
    """With Greek letters."""
    return re.sub("|".join(GREEK), lambda match: GREEK[match[0]], parameter.symbol)


def value(parameter, given):
    """A cell of the table."""
    if isinstance(given, str) and not parameter.choice:
        return f"{float(fractions.Fraction(given)):.3f}"
    return shown(parameter, given)


def meaning(parameter):
    beginning = f"{symbol(parameter)}: " if parameter.symbol else ""
    return beginning + parameter.short


def table(found, *keys):
    """The table of groups."""
    parameters = [parameter for key in keys for parameter in found.group(key, "table").parameters]
    has_thesis = any(p.in_preset for p in parameters)
    thesis = ("thesis | ", "--:|") if has_thesis else ("", "")
    lines = [
        f"| property | meaning | unit | default | {thesis[0]}why |",
        f"|---|---|---|--:|{thesis[1]}---|",
    ]
    for p in parameters:
        cells = [f"`{p.name}`", meaning(p), p.unit or "", value(p, p.default)]
        if has_thesis:
            cells.append(value(p, p.thesis) if p.in_engine else "")
        lines.append("| " + " | ".join([*cells, p.why or ""]) + " |")
    return [re.sub(" +\\|", " |", line) for line in lines]
