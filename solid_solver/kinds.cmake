# What a case chooses for a solid; cmake/Kinds.cmake says how. Each law gets a program solid_solver_<name>.
fsi_kind(law linear_elastic LinearElastic)
fsi_kind(law saint_venant_kirchhoff SaintVenantKirchhoff)
fsi_kind(law neo_hookean NeoHookean)
fsi_kind(law mooney_rivlin MooneyRivlin)
fsi_kind(law gent Gent)

# Boundaries of a solid, in the order of the documentation.
fsi_kind(solid_boundary interface Interface)
fsi_kind(solid_boundary slip_wall SlipWall)
fsi_kind(solid_boundary symmetry Symmetry)
fsi_kind(solid_boundary traction Traction)
fsi_kind(solid_boundary displacement Displacement)
fsi_kind(solid_boundary dirichlet Dirichlet)
fsi_kind(solid_boundary periodic Periodic)
