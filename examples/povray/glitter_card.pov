/*
 *  Persistence of Vision Raytracer scene file
 *
 *  File: glitter_card.pov
 *  Vers: 3.7
 *  Desc: a greeting card of craft glitter: exact flakes on a flat sheet, with letters that keep the paper free
 *
 *  povray +Iglitter_card.pov +L../../exporters/povray +W800 +H450 +A0.0 +AM1 +R4 -J Antialias_Gamma=1.0
 */
#version 3.7;
#include "glint.inc"

global_settings { assumed_gamma 1.0 max_trace_level 4 ambient_light color rgb 0.10 }

// One unit is a centimetre.
#declare Eye = <0, -13, 15>;
camera {
  location Eye
  sky z
  right -x*image_width/image_height
  direction 1.9*z
  look_at <0, 0.3, 0>
}

Glint_Point_Light(<-9, 12, 14>, <500, 450, 380>, 0.4)
Glint_Point_Light(<12, 5, 10>, <110, 140, 200>, 0.4)

#macro Glitter(Color, Alpha, Size, Seed)
  Glint_Reset()
  #declare Glint_Ndf = Glint_Beckmann;
  #declare Glint_Alpha = Alpha;
  #declare Glint_Lobe = 0.20;
  #declare Glint_Size = Size;
  #declare Glint_Seed = Seed;
  #declare Glint_F0 = Color;
  #declare Glint_Base = pigment { color rgb 0.5*Color }
  #declare Glint_Ambient = 1;
  Glint_Exact_Texture()
#end

#declare Rose   = Glitter(<1.00, 0.20, 0.30>, 0.40, 0.060, 1)
#declare Gold   = Glitter(<1.00, 0.66, 0.20>, 0.40, 0.060, 2)
#declare Teal   = Glitter(<0.06, 0.62, 0.62>, 0.40, 0.060, 3)
#declare Night  = Glitter(<0.020, 0.026, 0.10>, 0.50, 0.030, 4)

// A sheet of paper with pieces of glitter foil on it, each as thin as the paper.
#declare Star = prism {
  linear_sweep linear_spline 0, 0.02, 11
  #local I = 0;
  #while (I <= 10)
    #local R = (mod(I, 2) = 0 ? 1 : 0.42);
    <R*sin(pi*I/5), R*cos(pi*I/5)>
    #local I = I + 1;
  #end
  rotate -90*x
  scale <1, 1, -1>
}

plane { z, -0.01 pigment { color rgb <0.055, 0.045, 0.05> } finish { diffuse 1 ambient 1 } }
box { <-7.2, -4.1, 0>, <7.2, 4.5, 0.02> texture { Night } }
object { Star scale <3.5, 3.5, 1> translate <-2.6, 0.2, 0.03> texture { Gold } }
object { Star scale <2.0, 2.0, 1> rotate 18*z translate <2.0, 2.1, 0.03> texture { Rose } }
object { Star scale <2.5, 2.5, 1> rotate -14*z translate <4.2, -1.2, 0.03> texture { Teal } }
object { Star scale <1.2, 1.2, 1> rotate 30*z translate <0.9, -2.6, 0.03> texture { Rose } }
object { Star scale <0.9, 0.9, 1> rotate 9*z translate <-6.0, 3.2, 0.03> texture { Teal } }
object { Star scale <1.0, 1.0, 1> rotate 20*z translate <6.0, 3.0, 0.03> texture { Gold } }
