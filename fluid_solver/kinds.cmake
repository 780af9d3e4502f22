# What a case chooses for the gas; cmake/Kinds.cmake says how. The first Riemann solver is what a case without one gets.
fsi_kind(riemann_solver roe RiemannRoe)
fsi_kind(riemann_solver hllc RiemannHllc)

# Boundaries of the gas, in the order of the documentation.
fsi_kind(gas_boundary interface Interface)
fsi_kind(gas_boundary slip_wall SlipWall)
fsi_kind(gas_boundary symmetry Symmetry)
fsi_kind(gas_boundary inflow Inflow)
fsi_kind(gas_boundary imposed Imposed)
fsi_kind(gas_boundary outflow Outflow)
fsi_kind(gas_boundary far_field FarField)
fsi_kind(gas_boundary dirichlet Dirichlet)
fsi_kind(gas_boundary periodic Periodic)
