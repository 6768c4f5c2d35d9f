#include "harness.hpp"

namespace pelagos::validation {

const std::vector<Case>& all_cases() {
  static const std::vector<Case> cases = {
      {"hydrostatic", "Hydrostatic column",
       "A column 1 m deep stands for 5 s. The pressure of the particles over their height gives a straight line; its "
       "value at the bottom and its slope are compared, the force on a side is summed up from probes along it. The "
       "line is fitted two spacings off bottom and surface, the means are over the last second. The bottom is a mirror "
       "or a wall of samples.",
       "Closed form rho g H. A good code reaches 0.2 % at the bottom.", run_hydrostatic},
      {"still_water", "Still water, deep",
       "Water 30 particles deep at d = 1 m starts at rest from the lattice. What moves afterwards is the method's "
       "noise: "
       "rms speed from 15 to 30 s.",
       "0. Hybrid, dfsph and pbf run with the viscosity that they need to stay calm, the default one without any.",
       run_still_water},
      {"standing_wave", "Standing wave",
       "Half a wavelength between mirrors, as long as deep (k h = pi), released at rest. The amplitude is the "
       "surface's "
       "first Fourier mode.",
       "Period: second-order theory of Tadjbakhsh and Keller (1960). Amplitude: no loss; the best other particle code "
       "keeps 0.86 after 8.6 periods at h/d = 50 and a/h = 0.1.",
       run_standing_wave},
      {"travelling_wave", "Regular travelling wave",
       "One wavelength in a periodic box, amplitude one spacing, over a mirror. What a long swell loses on its way to "
       "the ship.",
       "Linear theory; the start has closed orbits (Gerstner), for which its frequency holds at any height. Peers lose "
       "15 to "
       "27 % a period; hybrid, dfsph and pbf run with the viscosity that they need to stay calm.",
       run_travelling_wave},
      {"solid_surfaces", "Solid surfaces: beds and bodies under water",
       "A wave of 60 m runs over a bed, flat or a sine of 0.7 m and 20 m length, that is a mesh and not a mirror. "
       "Bodies "
       "are held under water.",
       "Over the bed no loss: between mirrors the same wave loses 0.2 % a period. Force on bodies: Archimedes.",
       run_solid_surfaces},
      {"open_sea", "Open sea: waves through a patch with open edges",
       "Waves of the wave field run in and out through the edges of a patch, 1 m between particles. Regular waves, "
       "height "
       "length / 40, in a slice of 100 x 4 x 10 m with zones of 20 m for 20 periods; heights of the inner half over "
       "the "
       "last 60 % are fitted. JONSWAP seas with directions even over +-30 degrees in 80 x 80 x 6 m, zones of 15 m; 40 "
       "gauges over the inner 40 x 30 m, from 20 s on, the patch at rest or moving. Calm: the heights of a sea without "
       "waves, 50 to 60 s.",
       "The wave field itself. Gain: sum h h_theory / sum h_theory^2; correlation: Pearson's of all gauges together.",
       run_open_sea},
      {"sea_bed", "Open sea over a bed",
       "Flumes with open ends, 10 m deep, waves of 60 m. One stands on the level bottom of the sea. In the other a bar "
       "rises at 1:20 to a shelf of 40 m under 4 m of water, and falls at 1:10.",
       "Linear theory (Airy 1845); on the shelf the height that carries the same energy.", run_sea_bed},
      {"dam_break_front", "Dam break: the front",
       "A column twice as high as wide runs along a frictionless floor. The front is the largest x of the water that "
       "hangs together, plus half a spacing.",
       "Martin and Moyce (1952), Koshizuka and Oka (1996); and the finest of our own runs, for convergence. The error "
       "against the measured fronts grows with refinement: ours converge to a front that is ahead of them, probably "
       "because the floor has no friction, which was not tested.",
       run_dam_break_front},
      {"dam_break_pressure", "Dam break: pressure on the far wall",
       "A column 0.3 m high and 0.6 m long breaks and hits the wall at 1.61 m. Pressure there is the kernel-weighted "
       "mean "
       "of the particles within one support radius of the sensor.",
       "Lobovsky et al. (2014), median and 2.5 to 97.5 % band of 100 repetitions. Without friction at walls every "
       "particle front converges about 13 % too fast for theirs. Refining makes ours worse: it converges to a front "
       "that is ahead of the measured one, probably because walls have no friction here, which was not tested.",
       run_dam_break_pressure},
      {"taylor_green", "Taylor-Green vortices",
       "A periodic box without gravity, Re = 100, from the lattice. The energy's decay rate is fitted from 0.1 to 1.5 "
       "s. "
       "The solver's pressures only push, so a vortex may open voids: the share of particles beside one is measured.",
       "Energy decays as exp(-16 pi^2 t / Re). The rate gets worse, not better, from 50 to 100 particles a length: "
       "what "
       "is off depends on the order of the particles, see docs/physics.md.",
       run_taylor_green},
      {"square_patch", "Rotating square patch",
       "A square of water without gravity rotates as a solid. In truth its inside is under tension. Our pressures only "
       "push, so nothing holds the patch together: energy and angular momentum do not notice and prove nothing here, "
       "the "
       "covered area does.",
       "Energy rho w^2 L^4 / 12 at the start; energy, angular momentum and covered area constant.", run_square_patch},
      {"paper_dam_break", "The paper's dam break",
       "The paper's section VI.A: a box of 5L x 3L x 5L, a block of 1.6L x 1.5L x 2.0L, L = 1 m, 35,061 particles (the "
       "coarse runs: half of each length). The "
       "names with -paper are its three methods as printed: damped Jacobi, clamped increments, cold start. The "
       "tolerance, "
       "which the paper does not give, is 0.01 % here.",
       "Its figures 4 to 7 and the mean iterations in its text.", run_paper_dam_break},
      {"wind", "Wind",
       "The air's profile and gusts, and the energy of the mean flow that a channel without ends takes from a steady "
       "wind in 2 s, with steps of 4 and of 2 ms, under each law.",
       "Closed forms, Perlin's noise (2002), the drag of Large and Pond (1981).", run_wind},
      {"paper_wind", "The paper's wind waves",
       "Its section VI.B with L = 1 m: the wind and all its numbers as printed (a pulse of width 100 in a period of 10 "
       "never closes), a velocity added every step. A crest meets another where their water runs towards each other; "
       "water overturns where three particles or more stand over a gap of three spacings.",
       "Its figures 8 to 11 and what it says of them.", run_paper_wind},
      {"floating", "Bodies in the water",
       "Boxes and spheres in a patch between mirrors, where the level follows from the water's volume. Boxes of a "
       "fifth, "
       "a half and four fifths of the water's density float for 6 s; a barge is held, upright, heeled and in a "
       "current; a sphere "
       "under "
       "water is let go; one that floats half-sunk is let go from 0.2 of its radius below.",
       "Hydrostatics of the mesh (draft, force, righting moment); the added mass of a sphere; the measured heave of a "
       "sphere. Another particle code reaches 1.1 to 1.2 % of the draft and drifts by 8.8 % of the length in 10 s.",
       run_floating},
      {"interface_density", "Density at the interface of two liquids",
       "Particles on a line, 1000 kg/m^3 on the left and 400 on the right: the standard sum smears the step over a "
       "kernel, the number density does not.",
       "The paper's figure 1; sums evaluated independently.", run_interface_density},
      {"oil_at_rest", "Oil over water at rest",
       "Half a metre of oil (800 kg/m^3) on half a metre of water, between mirrors, for 5 s.",
       "Hydrostatics; both liquids stay where they are.", run_oil_at_rest},
      {"rayleigh_taylor", "Water over oil, and oil over water",
       "A box one wavelength long, two layers, the upper one two spacings below the lid, their interface pushed into a "
       "wave. With the water above the wave "
       "grows, with the oil above it swings. Not a number: viscosity let it never grow to k a = 0.06.",
       "Linear theory of two layers (Lamb 1932). A prototype of the method grew 18 % too slowly at 60 d and 33 % at 30 "
       "d.",
       run_rayleigh_taylor},
      {"lock_exchange", "Lock exchange",
       "Oil of 950 kg/m^3 on one side of a box and water on the other, two spacings below its lid: the water runs "
       "under, the "
       "oil above. Not a number: viscosity let the fronts not come far enough.",
       "The front speed of a computation without wall friction, 0.477 sqrt(g' H) (Haertel et al. 2000).",
       run_lock_exchange},
      {"oil_slump", "Oil spreading on deep water",
       "Half a block of oil at a mirror, afloat, spreads in two dimensions until it is three spacings thin. The length "
       "is that of 99 % of the oil; L^(3/2) grows evenly, and its slope gives the coefficient.",
       "Similarity solutions for fronts of Froude number 1 to sqrt 2: 1.39 to 1.89 (g' A)^(1/3) t^(2/3).",
       run_oil_slump},
      {"oil_drop", "A drop of two liquids without gravity",
       "A ball, a part of it oil, whose halves fly at each other and spin, for 0.8 s.", "Its momentum stays.",
       run_oil_drop},
      {"oil_spill", "The paper's oil spill",
       "Its section VI.C: 64,251 particles of water and 10,179 of oil, at a tolerance of 0.1 %.",
       "The paper's 2.44 s a step; a step of the same scene without oil.", run_oil_spill},
      {"work_precision", "Work and precision",
       "Three small problems while one knob is turned: tolerance, time step, resolution. Wall time for a simulated "
       "second "
       "against the error. Every point is one run; the four solvers that a scene chooses by default, not their "
       "variants.",
       "Each other. Other people's programs are not timed here.", run_work_precision},
  };
  return cases;
}

}  // namespace pelagos::validation
