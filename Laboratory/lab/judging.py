# SPDX-License-Identifier: BSD-3-Clause
"""How claims are judged by tables. Each function here makes a judge.

A case is a model, or whatever else the factor `over` tells apart; in it, means over the seeds are
compared. One is larger than another where they differ by more than the standard error of their
difference.
"""

from __future__ import annotations

import math
from typing import Any, Callable, Iterator, Sequence

import numpy as np

from .experiment import Finding, Judge
from .table import COLUMNS, Table


def ordered(
    column: str, factor: str, values: Sequence[Any], rises: bool, over: str = "model"
) -> Judge:
    """That the figure rises, or falls, from each of the values of the factor to the next one."""

    def judge(table: Table) -> Finding:
        cases, words = {}, []
        for case, part in _cases(table, over):
            parts = [part.where(**{factor: value}) for value in values]
            pairs = zip(parts, parts[1:])
            cases[case] = all(
                is_larger(column, *(pair if not rises else pair[::-1])) for pair in pairs
            )
            words.append(f"{case} {_arrows(column, parts)}")
        return Finding(cases, _sentence(column, words))

    return judge


def larger(
    column: str, factor: str, value: Any, than: Any, by: float = 1.0, over: str = "model"
) -> Judge:
    """That the figure is larger with one value of the factor than with another, by such a factor."""

    def judge(table: Table) -> Finding:
        cases, words = {}, []
        for case, part in _cases(table, over):
            one, other = part.where(**{factor: value}), part.where(**{factor: than})
            if by == 1.0:
                cases[case] = is_larger(column, one, other)
            else:
                cases[case] = one.mean(column) >= by * other.mean(column)
            words.append(f"{case} {_arrows(column, [other, one])} {_ratio(column, one, other)}")
        return Finding(cases, _sentence(column, words))

    return judge


def alike(
    column: str, factor: str, value: Any, other: Any, within: float, over: str = "model"
) -> Judge:
    """That the figures with two values of the factor differ by such a part at most."""

    def judge(table: Table) -> Finding:
        cases, words = {}, []
        for case, part in _cases(table, over):
            one, two = part.where(**{factor: value}), part.where(**{factor: other})
            cases[case] = abs(one.mean(column) - two.mean(column)) <= within * two.mean(column)
            words.append(f"{case} {_arrows(column, [two, one])} {_ratio(column, one, two)}")
        return Finding(cases, _sentence(column, words))

    return judge


def every_run(column: str, is_so: Callable[[float], bool], said: str, **factors: Any) -> Judge:
    """That something is so of the figures of each run; a case is a model, in most of whose runs."""

    def judge(table: Table) -> Finding:
        cases, words = {}, []
        for case, part in _cases(table.where(**factors), "model"):
            figures = part.figures(column)
            count = sum(bool(is_so(figure)) for figure in figures)
            cases[case] = 2 * count > len(figures)
            words.append(f"{case} in {count} of {len(figures)} runs")
        return Finding(cases, f"{said}: {'; '.join(words)}")

    return judge


def is_larger(column: str, one: Table, other: Table) -> bool:
    difference = one.mean(column) - other.mean(column)
    return bool(difference > math.hypot(one.error(column), other.error(column)))


def exponent(sizes: np.ndarray, costs: np.ndarray) -> float:
    """By which power of the size the cost grows."""
    kept = (sizes > 0) & (costs > 0)
    return float(np.polyfit(np.log(sizes[kept]), np.log(costs[kept]), 1)[0])


def _cases(table: Table, over: str) -> Iterator[tuple[str, Table]]:
    for (value,), part in table.groups(over):
        yield str(value), part


def _arrows(column: str, parts: list[Table]) -> str:
    return " → ".join(COLUMNS[column].text(part.mean(column), with_unit=False) for part in parts)


def _ratio(column: str, one: Table, other: Table) -> str:
    """How many times; of what is told in percent already, and of angles, that says little."""
    mean = other.mean(column)
    return f"(× {one.mean(column) / mean:.2f})" if mean > 0 else ""


def _sentence(column: str, words: list[str]) -> str:
    shown = COLUMNS[column]
    unit = f", {shown.unit}" if shown.unit else ""
    return f"{shown.title}{unit}: {'; '.join(word.strip() for word in words)}"
