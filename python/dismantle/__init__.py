# SPDX-License-Identifier: Apache-2.0
"""Virtual disassembly with continuous collision handling: docs/python.md.

Lengths are in mm, angles in rad, times in s. A pose is seven numbers: x, y, z, and the quaternion w, x, y, z. It maps
assembled coordinates of a component to current ones.
"""
from dismantle._dismantle import *  # noqa: F401,F403
from dismantle._dismantle import __version__  # noqa: F401
