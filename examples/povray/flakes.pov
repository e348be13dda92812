/*
 *  Persistence of Vision Raytracer scene file
 *
 *  File: flakes.pov
 *  Vers: 3.7
 *  Desc: three vases of the same lathe: what the roughness of a flake does, from hard sparkle to silk
 *
 *  povray +Iflakes.pov +L../../exporters/povray +W800 +H450 +A0.0 +AM1 +R4 -J Antialias_Gamma=1.0
 */
#version 3.7;
#include "glint.inc"

global_settings { assumed_gamma 1.0 max_trace_level 5 ambient_light color rgb 0.22 }

camera {
  location <0, 1.35, -6.2>
  right x*image_width/image_height
  direction 2.0*z
  look_at <0, 0.86, 0>
}

Glint_Point_Light(<-3.5, 4.5, -4.0>, <34, 31, 27>, 0.25)
Glint_Point_Light(<4.5, 2.2, -2.5>, <6, 8, 12>, 0.25)
Glint_Point_Light(<1.5, 4.0, 4.5>, <24, 22, 26>, 0.25)

sky_sphere {
  pigment {
    function { max(0, y) }
    color_map { [0 color rgb <0.10, 0.09, 0.11>] [0.5 color rgb <0.32, 0.34, 0.40>] [1 color rgb <0.55, 0.58, 0.66>] }
  }
}

#declare Vase = lathe {
  cubic_spline 9,
  <-0.30, 0.02>, <0.34, 0.00>, <0.62, 0.45>, <0.60, 0.85>, <0.30, 1.25>, <0.20, 1.48>, <0.27, 1.68>, <0.24, 1.70>, <0.15, 1.55>
}

#macro Vase_Texture(Color, Lobe, Size)
  Glint_Reset()
  #declare Glint_Ndf = Glint_Beckmann;
  #declare Glint_Alpha = 0.32;
  #declare Glint_Lobe = Lobe;
  #declare Glint_Size = Size;
  #declare Glint_F0 = Color;
  #declare Glint_Base = pigment { color rgb 0.10*Color }
  #declare Glint_Ambient = 1;
  #declare Glint_Mirror = 0.6;
  Glint_Portable_Texture()
#end

#declare Hard = Vase_Texture(<0.95, 0.50, 0.42>, 0.06, 0.022)
#declare Soft = Vase_Texture(<0.95, 0.80, 0.45>, 0.12, 0.016)
#declare Silk = Vase_Texture(<0.45, 0.62, 0.85>, 0.25, 0.012)

object { Vase translate <-1.45, 0, 0.25> texture { Hard } }
object { Vase translate <0, 0, -0.10> texture { Soft } }
object { Vase translate <1.45, 0, 0.25> texture { Silk } }

Glint_Reset()
#declare Glint_Alpha = 0.16;
#declare Glint_F0 = <0.04, 0.04, 0.04>;
#declare Glint_Base = pigment { color rgb <0.10, 0.09, 0.10> }
#declare Glint_Ambient = 1;
#declare Glint_Mirror = 1;
#declare Floor = Glint_Smooth_Texture()
plane { y, 0 texture { Floor } }
