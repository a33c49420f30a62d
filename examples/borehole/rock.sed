# Of a calibrated recipe its rock alone: without the laboratory's specimen and test, and with as many grains of the same size as a
# larger block takes (the porosity is the paper's). Behind examples/borehole/opening.toml or examples/tunnel/opening.toml it is whole.
#   sed -f examples/borehole/rock.sed CALIBRATED.toml | cat examples/borehole/opening.toml - > OPENING.toml
/^name/d
/^\[specimen\]/,/^$/d
/^\[test\]/,/^$/d
s/^n_grains = .*/n_grains = 0/
s/^porosity = .*/porosity = 0.0815/
