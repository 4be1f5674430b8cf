// From ellipsoids: vertices averaged (V), steps down the gradient (g), Newton's with a line search (hessian_seek).
// With one hessian_seek in place of two a run is over in half the time, but the prolate is not found; more than two change nothing.
begin := { {V; g 5} 2; {hessian_seek} 2; V; hessian_seek; }
finer := { r; V; {hessian_seek} 2; V; {hessian_seek} 2; g 3; }
