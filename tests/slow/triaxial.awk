# A closed triangulation (OFF) as a data file of Surface Evolver: Willmore energy at fixed area 4 pi, reduced volume nu and area difference m.
BEGIN { pi = 4 * atan2(1, 1) }
/^#/ || NF == 0 || $1 == "OFF" { next }
!vertices { vertices = $1; next }
at < vertices { place[++at] = $1 " " $2 " " $3; next }
{
  row = ""
  for (k = 2; k <= 4; k++) {
    a = $k + 1; b = $(k < 4 ? k + 1 : 2) + 1
    if (!(b SUBSEP a in edge)) { edge[a, b] = ++edges; ends[edges] = a " " b; row = row " " edges }
    else row = row " -" edge[b, a]
  }
  facet[++count] = row
}
END {
  print "quantity bend energy method star_perp_sq_mean_curvature global"
  printf "quantity ar fixed = %.15g method facet_area global\n", 4 * pi
  printf "quantity mc fixed = %.15g method mean_curvature_integral global\n", 4 * pi * m
  print "vertices"; for (k = 1; k <= at; k++) print k, place[k]
  print "edges"; for (k = 1; k <= edges; k++) print k, ends[k]
  print "faces"; for (k = 1; k <= count; k++) print k facet[k], "tension 0"
  printf "bodies\n1"; for (k = 1; k <= count; k++) printf " %d", k
  printf " volume %.15g\nread\nhessian_normal\n", nu * 4 * pi / 3
}
