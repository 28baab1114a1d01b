# SPDX-License-Identifier: BSD-3-Clause
"""The laboratory: the experiments of the thesis again, what is behind python3 -m neuralmesh.lab.

An experiment is a table of cases and a list of claims. A case is a run of the method, by what it is
called in the table; a claim is what the thesis says, and a function that judges it by the table.
Runs are done by processes and stored one by one; tables, plots and the report are made of what is
stored.
"""
