# SPDX-License-Identifier: BSD-3-Clause
"""What a comparison tells of both directions together, by the names in the field data of its table."""

from __future__ import annotations

BOTH_WAYS = (
    "Hausdorff", "HausdorffPercent", "NormalAngle", "NormalConsistency", "Chamfer", "ChamferPercent",
    "ChamferSquared", "Precision0_1", "Recall0_1", "FScore0_1", "Precision0_5", "Recall0_5", "FScore0_5",
    "EdgeChamfer", "EdgeChamferPercent",
)  # fmt: skip
