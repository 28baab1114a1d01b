# SPDX-License-Identifier: BSD-3-Clause
"""What the package does where no VTK was built with it: by the engine alone, whatever VTK is there."""
