# image_oiio.cpp and what goes with it
