!> What PLAXIS asks of a library of user-defined soil models: names, units and counts of models, parameters and state
!> variables.
!>
!> Texts go out as PLAXIS takes them: the first byte is the length, the text follows, nothing behind it is written. In
!> names _ begins and # ends a subscript, in units ^ and # a superscript; F is the unit of force, L that of length.
!> The symbols are in lower case without an underscore, as the compilers that PLAXIS names export them.
module umat_plaxis_queries
  use, intrinsic :: iso_c_binding, only: c_char, c_int
  use umat_material, only: parameters, n_parameters
  use umat_plaxis, only: n_plaxis_parameters, n_plaxis_statev
  implicit none
  private

  !> Components of tensors in PLAXIS' order.
  character(len=2), parameter :: axes(6) = ['xx', 'yy', 'zz', 'xy', 'yz', 'zx']
  character(len=*), parameter :: unit_of_stress = 'F/L^2#'
  !> State variables after delta.
  character(len=16), parameter :: names(7:n_plaxis_statev) = [character(len=16) :: &
    'void ratio', 'not used', 'p', 'evaluations', 'mobilised phi', 'rho', 'substep', 'dropped']
  character(len=8), parameter :: units(7:n_plaxis_statev) = [character(len=8) :: &
    '-', unit_of_stress, unit_of_stress, '-', 'deg', '-', '-', '-']

contains

  !> Number of models: one.
  subroutine get_model_count(count) bind(C, name='getmodelcount')
    integer(c_int), intent(out) :: count
    count = 1
  end subroutine get_model_count

  !> Name of a model; none where there is no such model.
  subroutine get_model_name(model, name) bind(C, name='getmodelname')
    integer(c_int), intent(in) :: model
    character(kind=c_char), intent(inout) :: name(*)
    if (model == 1) then
      call give('hypofab sand', name)
    else
      call give('', name)
    end if
  end subroutine get_model_name

  !> Number of parameters of a model.
  subroutine get_param_count(model, count) bind(C, name='getparamcount')
    integer(c_int), intent(in) :: model
    integer(c_int), intent(out) :: count
    count = merge(n_plaxis_parameters, 0, model == 1)
  end subroutine get_param_count

  !> Name of a parameter, from 1; none where there is no such parameter.
  subroutine get_param_name(model, index, name) bind(C, name='getparamname')
    integer(c_int), intent(in) :: model, index
    character(kind=c_char), intent(inout) :: name(*)
    if (model /= 1 .or. index < 1 .or. index > n_plaxis_parameters) then
      call give('', name)
    else if (index > n_parameters) then
      call give('delta_'//axes(index - n_parameters)//'#', name)
    else
      call give(marked(parameters(index)%name), name)
    end if
  end subroutine get_param_name

  !> Unit of a parameter.
  subroutine get_param_unit(model, index, unit) bind(C, name='getparamunit')
    integer(c_int), intent(in) :: model, index
    character(kind=c_char), intent(inout) :: unit(*)
    character(len=:), allocatable :: text
    text = ''
    if (model == 1 .and. index >= 1 .and. index <= n_plaxis_parameters) text = '-'
    if (model == 1 .and. index >= 1 .and. index <= n_parameters) then
      text = plain(parameters(index)%unit)
      if (text == 'stress') text = unit_of_stress
    end if
    call give(text, unit)
  end subroutine get_param_unit

  !> Number of state variables of a model.
  subroutine get_state_var_count(model, count) bind(C, name='getstatevarcount')
    integer(c_int), intent(in) :: model
    integer(c_int), intent(out) :: count
    count = merge(n_plaxis_statev, 0, model == 1)
  end subroutine get_state_var_count

  !> Name of a state variable, from 1.
  subroutine get_state_var_name(model, index, name) bind(C, name='getstatevarname')
    integer(c_int), intent(in) :: model, index
    character(kind=c_char), intent(inout) :: name(*)
    if (model /= 1 .or. index < 1 .or. index > n_plaxis_statev) then
      call give('', name)
    else if (index <= 6) then
      call give('delta_'//axes(index)//'#', name)
    else
      call give(trim(names(index)), name)
    end if
  end subroutine get_state_var_name

  !> Unit of a state variable.
  subroutine get_state_var_unit(model, index, unit) bind(C, name='getstatevarunit')
    integer(c_int), intent(in) :: model, index
    character(kind=c_char), intent(inout) :: unit(*)
    if (model /= 1 .or. index < 1 .or. index > n_plaxis_statev) then
      call give('', unit)
    else if (index <= 6) then
      call give('-', unit)
    else
      call give(trim(units(index)), unit)
    end if
  end subroutine get_state_var_unit

  !> Write a text with its length in front.
  subroutine give(text, buffer)
    character(len=*), intent(in) :: text
    character(kind=c_char), intent(inout) :: buffer(*)
    integer :: i
    buffer(1) = achar(len(text), kind=c_char)
    do i = 1, len(text)
      buffer(i + 1) = text(i:i)
    end do
  end subroutine give

  !> A text of the parameter table without the null character at its end.
  pure function plain(text) result(cut)
    character(len=*), intent(in) :: text
    character(len=:), allocatable :: cut
    cut = text(:index(text, achar(0)) - 1)
  end function plain

  !> A name with the end of its subscript marked.
  pure function marked(text) result(name)
    character(len=*), intent(in) :: text
    character(len=:), allocatable :: name
    name = plain(text)
    if (index(name, '_') > 0) name = name//'#'
  end function marked

end module umat_plaxis_queries
