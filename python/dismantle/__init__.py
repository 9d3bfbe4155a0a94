# SPDX-License-Identifier: Apache-2.0
"""Virtual disassembly with continuous collision handling: docs/python.md.

Lengths are millimetres, angles radians. A pose is seven numbers, x, y, z and the quaternion w, x, y, z; it maps a
component's assembled place to where it is now.
"""
from dismantle._dismantle import *  # noqa: F401,F403
from dismantle._dismantle import __version__  # noqa: F401
