# SPDX-License-Identifier: MIT
"""The names of pygeodesic; they are in its module geodesic, as there."""
