# SPDX-License-Identifier: BSD-3-Clause
"""All experiments, in the order of the thesis."""

from __future__ import annotations

from . import chapter_6, chapter_13, chapter_14, chapters_7_to_10
from .experiment import Experiment

EXPERIMENTS: dict[str, Experiment] = {
    experiment.name: experiment
    for chapter in (chapter_6, chapters_7_to_10, chapter_13, chapter_14)
    for experiment in chapter.EXPERIMENTS
}
