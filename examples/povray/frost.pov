/*
 *  Persistence of Vision Raytracer scene file
 *
 *  File: frost.pov
 *  Vers: 3.7
 *  Desc: a snowfield under a low sun, with spheres of ice and gold leaf; portable glints on any shape
 *
 *  povray +Ifrost.pov +L../../exporters/povray +W800 +H450 +A0.0 +AM1 +R4 -J Antialias_Gamma=1.0
 */
#version 3.7;
#include "glint.inc"

global_settings { assumed_gamma 1.0 max_trace_level 5 ambient_light color rgb <0.10, 0.16, 0.30> }

camera {
  location <0, 0.55, -2.6>
  right x*image_width/image_height
  direction 1.9*z
  look_at <0, 0.28, 0>
}

Glint_Sun(<-0.75, 0.42, 0.75>, <3.4, 2.6, 1.9>, 0.02)
Glint_Point_Light(<2.2, 1.6, -2.0>, <1.0, 1.5, 2.6>, 0.1)

sky_sphere {
  pigment {
    function { max(0, y) }
    color_map {
      [0.00 color rgb <0.55, 0.34, 0.28>]
      [0.12 color rgb <0.24, 0.24, 0.40>]
      [0.60 color rgb <0.03, 0.06, 0.17>]
    }
  }
}

// Snow: matt, with a crystal face here and there that flashes.
Glint_Reset()
#declare Glint_Alpha = 0.6;
#declare Glint_Lobe = 0.12;
#declare Glint_Size = 0.006;
#declare Glint_F0 = <0.25, 0.25, 0.25>;
#declare Glint_Base = pigment { color rgb <0.78, 0.84, 0.93> }
#declare Glint_Ambient = 1;
#declare Snow = Glint_Portable_Texture()

// Gold leaf, wrinkled.
Glint_Reset()
#declare Glint_Alpha = 0.22;
#declare Glint_Lobe = 0.08;
#declare Glint_Size = 0.012;
#declare Glint_F0 = <1.00, 0.71, 0.29>;
#declare Glint_Mirror = 1;
#declare Gold = Glint_Portable_Texture()

// A blue lacquer with silver flakes under a clear coat.
Glint_Reset()
#declare Glint_Ndf = Glint_Beckmann;
#declare Glint_Alpha = 0.25;
#declare Glint_Lobe = 0.10;
#declare Glint_Size = 0.006;
#declare Glint_F0 = <0.55, 0.60, 0.70>;
#declare Glint_Coverage = 0.6;
#declare Glint_Base = pigment { color rgb <0.01, 0.04, 0.20> }
#declare Glint_Coat = 1;
#declare Glint_Ambient = 1;
#declare Lacquer = Glint_Portable_Texture()

height_field {
  function 300, 300 { pattern { bumps scale 0.16 } }
  smooth
  translate <-0.5, 0, -0.35>
  scale <9, 0.42, 9>
  translate <0, -0.30, 0>
  texture { Snow }
}
sphere { <-0.62, 0.30, 0.35>, 0.36 texture { Gold } }
sphere { <0.46, 0.26, 0.05>, 0.30 texture { Lacquer } }
sphere { <-0.02, 0.12, -0.42>, 0.13 texture { Gold } }
