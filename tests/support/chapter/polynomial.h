// The real roots of a polynomial of low degree, by bisection between its turning points.
#pragma once

#include <cmath>
#include <initializer_list>

namespace onde::chapter {

/// A handful of values without an allocation; more than fit are dropped.
template <class T, int CAPACITY>
struct Few {
    T values[CAPACITY];
    int count = 0;
    void add(const T& value) {
        if (count < CAPACITY) values[count++] = value;
    }
    const T* begin() const { return values; }
    const T* end() const { return values + count; }
};

using Roots = Few<double, 4>;

/// coefficient[i] belongs to x^i; a degree of at most 4.
struct Polynomial {
    double coefficient[5] = {};
    int degree = 0;

    Polynomial(std::initializer_list<double> from_constant) {
        for (const double value : from_constant) coefficient[degree++] = value;
        --degree;
    }
    double at(double x) const {
        double sum = coefficient[degree];
        for (int i = degree; i-- > 0;) sum = sum * x + coefficient[i];
        return sum;
    }
    Polynomial derivative() const {
        Polynomial result{0};
        result.degree = degree - 1;
        for (int i = 0; i < degree; ++i) result.coefficient[i] = (i + 1) * coefficient[i + 1];
        return result;
    }
};

/// The roots in (low, high) at which the sign changes, ascending: between two neighbouring turning
/// points there is at most one, and halving finds it to the last bit.
inline Roots roots(const Polynomial& f, double low, double high) {
    Roots found;
    const Roots turns = f.degree > 1 ? roots(f.derivative(), low, high) : Roots();
    double left = low;
    for (int i = 0; i <= turns.count; ++i) {
        const double right = i < turns.count ? turns.values[i] : high;
        double a = left, b = right;
        left = right;
        const bool rises = f.at(b) > 0;
        if ((f.at(a) > 0) == rises) continue;
        for (int halvings = 0; halvings < 200; ++halvings) {
            const double middle = 0.5 * (a + b);
            if (middle == a || middle == b) break;
            ((f.at(middle) > 0) == rises ? b : a) = middle;
        }
        found.add(0.5 * (a + b));
    }
    return found;
}

} // namespace onde::chapter
