# Shapes of outlines and walls, in the order of the documentation; cmake/Kinds.cmake says how.
fsi_kind(shape circle Circle)
fsi_kind(shape ellipse Ellipse)
fsi_kind(shape polygon Polygon)
fsi_kind(shape spline Spline)
