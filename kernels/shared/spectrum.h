// Light of one wavelength, for what bends light of each differently. Wavelengths are drawn as often
// as red, green and blue respond to them on average; the table has knots by the draw, in equal
// steps from 0 to 1, between which it is linear.
#ifndef ONDE_SHARED_SPECTRUM_H
#define ONDE_SHARED_SPECTRUM_H

typedef struct {
    float bend;     // by which its index of refraction is beyond that of the d line; see Material
    float color[3]; // of white light, over the density of the draw; the mean is 1
} SpectrumKnot;
#define SPECTRUM_KNOTS 129u

#endif
