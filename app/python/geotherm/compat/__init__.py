# SPDX-License-Identifier: MIT
"""Other packages' names over geotherm: for programs that change one line.

    import geotherm.compat.potpourri3d as pp3d
    import geotherm.compat.pygeodesic.geodesic as geodesic

What does not work raises geotherm.Error, and an option that is not there NotImplementedError.
"""
