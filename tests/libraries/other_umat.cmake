# The same model with a pi of 3: a friction angle in degrees means another sand.
file(READ ${SOURCE} text)
string(REPLACE "3.14159265358979323846264338327950288" "3.0" text "${text}")
file(WRITE ${OUTPUT} "${text}")
