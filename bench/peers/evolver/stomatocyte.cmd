// From the bowl, which is far from its optimum: edges are swapped (u) where that makes triangles more alike.
// With half the steps after each refinement a run takes half the time and has twice the excess.
begin := { {u; V; u; V; u; g 10} 6; {V; g 10} 2; {hessian_seek} 4; }
finer := { r; {u; V; g 10} 4; {V; g 10} 2; {hessian_seek} 8; g 3; }
