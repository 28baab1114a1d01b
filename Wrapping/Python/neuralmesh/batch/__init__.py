# SPDX-License-Identifier: BSD-3-Clause
"""Many scans by one recipe: what is behind python3 -m neuralmesh batch.

A recipe gives jobs, a job is one scan with one set of parameters. Each runs in a process of its
own, which leaves a mesh and a report, or a report of what went wrong. Afterwards a summary and a
gallery are made of all reports.
"""
